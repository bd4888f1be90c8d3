#include "engine/module/interface.h"
#include "engine/core/log.h"
#include "engine/module/dwarf_internal.h"
#include "engine/module/type_hash_internal.h"
#include <stdlib.h>
#include <string.h>

enum { FOLDER_MAX = 64, SLOTS_FIRST = 4096, TEXT_BLOCK = 65536 };

typedef struct fact {
    const char *name; /* NULL: a free slot */
    uint64_t hash;
    uint32_t folder; /* into folders */
    bool is_function;
} fact;

/* Texts live in blocks that stay where they are. */
typedef struct text_block {
    struct text_block *before;
    size_t used;
    char text[TEXT_BLOCK];
} text_block;

struct nook_interface {
    fact *slots; /* open addressing by name: all that a name stands for is in one run; at most half full */
    size_t slot_count, fact_count;
    char (*folders)[FOLDER_MAX]; /* of source files, "engine/core/" */
    uint32_t folder_count, folder_capacity;
    text_block *texts;
};

static size_t hash_name(const char *name)
{
    uint64_t hash = 0xCBF29CE484222325u;
    for (; *name; name++)
        hash = (hash ^ (uint8_t)*name) * 0x100000001B3u; /* FNV-1a */
    return (size_t)(hash ^ hash >> 32);
}

/* ---- making it ---- */

static const char *copy_text(nook_interface *interface, const char *text)
{
    size_t size = strlen(text) + 1;
    text_block *block = interface->texts;
    if (size > TEXT_BLOCK)
        return NULL;
    if (!block || TEXT_BLOCK - block->used < size) {
        block = malloc(sizeof *block);
        if (!block)
            return NULL;
        block->before = interface->texts;
        block->used = 0;
        interface->texts = block;
    }
    char *copy = block->text + block->used;
    memcpy(copy, text, size);
    block->used += size;
    return copy;
}

/* The slot of that fact, or the free one where it belongs. */
static fact *find_slot(fact *slots, size_t slot_count, const fact *wanted)
{
    size_t at = hash_name(wanted->name) & (slot_count - 1);
    for (;; at = (at + 1) & (slot_count - 1)) {
        const fact *found = &slots[at];
        if (!found->name || (found->hash == wanted->hash && found->folder == wanted->folder &&
                             found->is_function == wanted->is_function && strcmp(found->name, wanted->name) == 0))
            return &slots[at];
    }
}

static bool reserve_slot(nook_interface *interface)
{
    if (2 * (interface->fact_count + 1) <= interface->slot_count)
        return true;
    size_t slot_count = interface->slot_count ? interface->slot_count * 2 : SLOTS_FIRST;
    fact *slots = calloc(slot_count, sizeof *slots);
    if (!slots)
        return false;
    for (size_t i = 0; i < interface->slot_count; i++) {
        if (interface->slots[i].name)
            *find_slot(slots, slot_count, &interface->slots[i]) = interface->slots[i];
    }
    free(interface->slots);
    interface->slots = slots;
    interface->slot_count = slot_count;
    return true;
}

/* @return false without memory */
static bool add_fact(nook_interface *interface, fact added)
{
    if (!reserve_slot(interface))
        return false;
    fact *slot = find_slot(interface->slots, interface->slot_count, &added);
    if (slot->name)
        return true;
    added.name = copy_text(interface, added.name);
    if (!added.name)
        return false;
    *slot = added;
    interface->fact_count++;
    return true;
}

/* Of the folder of a source file, as the compiler was told it: from the folder of the build, "../../engine/core/file.c". */
static bool add_folder(nook_interface *interface, const char *source, uint32_t *out_folder)
{
    char folder[FOLDER_MAX] = "";
    while (strncmp(source, "../", 3) == 0)
        source += 3;
    const char *slash = strrchr(source, '/');
    if (slash && (size_t)(slash - source) + 1 < FOLDER_MAX)
        memcpy(folder, source, (size_t)(slash - source) + 1);
    for (*out_folder = 0; *out_folder < interface->folder_count; ++*out_folder) {
        if (strcmp(interface->folders[*out_folder], folder) == 0)
            return true;
    }
    if (interface->folder_count == interface->folder_capacity) {
        uint32_t capacity = interface->folder_capacity ? interface->folder_capacity * 2 : 64;
        char(*folders)[FOLDER_MAX] = realloc(interface->folders, capacity * sizeof *folders);
        if (!folders)
            return false;
        interface->folders = folders;
        interface->folder_capacity = capacity;
    }
    memcpy(interface->folders[interface->folder_count++], folder, FOLDER_MAX);
    return true;
}

static bool is_type(uint32_t tag)
{
    return tag == DWARF_TAG_STRUCT || tag == DWARF_TAG_UNION || tag == DWARF_TAG_ENUMERATION;
}

/* Types that are declared only are described elsewhere; those without a name of their own may have one by typedef. */
static bool add_entry(nook_interface *interface, const nook_dwarf_unit *unit, size_t place,
                      const nook_dwarf_entry *entry, uint32_t folder)
{
    if (entry->name[0] == '\0')
        return true;
    if (entry->tag == DWARF_TAG_FUNCTION && entry->external)
        return add_fact(interface, (fact){ entry->name, nook_function_hash(unit, entry), folder, true });
    if (is_type(entry->tag) && !entry->declaration)
        return add_fact(interface, (fact){ entry->name, nook_type_hash(unit, place), folder, false });
    if (entry->tag == DWARF_TAG_TYPEDEF && entry->type != 0) {
        nook_dwarf_entry named = nook_dwarf_entry_read(unit, entry->type);
        if (is_type(named.tag) && named.name[0] == '\0')
            return add_fact(interface, (fact){ entry->name, nook_type_hash(unit, entry->type), folder, false });
    }
    return true;
}

static bool add_unit(nook_interface *interface, const nook_dwarf_unit *unit)
{
    nook_dwarf_entry root = nook_dwarf_entry_read(unit, unit->root);
    uint32_t folder;
    if (!add_folder(interface, root.name, &folder))
        return false;
    for (size_t place = root.next; root.has_children && place < unit->bytes.size;) {
        nook_dwarf_entry entry = nook_dwarf_entry_read(unit, place);
        if (entry.tag == 0)
            return true;
        if (!add_entry(interface, unit, place, &entry, folder))
            return false;
        place = nook_dwarf_skip(unit, &entry);
    }
    return true;
}

static nook_result add_all(const char *path, const nook_debug_sections *sections, nook_interface *interface)
{
    nook_dwarf_unit unit = { 0 };
    nook_result result = NOOK_OK;
    for (size_t offset = 0; offset < sections->info.size && result == NOOK_OK;) {
        result = nook_dwarf_unit_read(path, sections, offset, &unit, &offset);
        if (result == NOOK_OK && unit.root != 0 && !add_unit(interface, &unit))
            result = nook_fail(NOOK_E_MEMORY, "%s: no memory for what it holds", path);
    }
    nook_dwarf_unit_free(&unit);
    if (result == NOOK_OK && interface->fact_count == 0)
        return nook_fail(NOOK_E_FORMAT, "%s: its debug information tells of no types; build it with -g", path);
    return result;
}

nook_result nook_interface_read(const char *path, nook_interface **out_interface)
{
    nook_debug_sections sections;
    *out_interface = NULL;
    nook_result result = nook_debug_sections_read(path, &sections);
    if (result != NOOK_OK)
        return result;
    nook_interface *interface = calloc(1, sizeof *interface);
    result = interface ? add_all(path, &sections, interface) : nook_fail(NOOK_E_MEMORY, "%s: no memory", path);
    nook_debug_sections_free(&sections);
    if (result == NOOK_OK)
        *out_interface = interface;
    else
        nook_interface_free(interface);
    return result;
}

void nook_interface_free(nook_interface *interface)
{
    if (!interface)
        return;
    while (interface->texts) {
        text_block *block = interface->texts;
        interface->texts = block->before;
        free(block);
    }
    free(interface->slots);
    free(interface->folders);
    free(interface);
}

/* ---- comparing ---- */

static bool starts_with_any(const char *folder, const char *const *starts)
{
    for (; *starts; starts++) {
        if (strncmp(folder, *starts, strlen(*starts)) == 0)
            return true;
    }
    return false;
}

static bool sees(const nook_interface_view *view, const fact *known)
{
    const char *folder = view->interface->folders[known->folder];
    return (!view->folders || starts_with_any(folder, view->folders)) &&
           !(view->without && starts_with_any(folder, view->without));
}

static bool in_scope(const fact *known, unsigned scope)
{
    bool is_public = strncmp(known->name, "nook_", 5) == 0;
    if (known->is_function)
        return (scope & NOOK_INTERFACE_FUNCTIONS) != 0 && is_public;
    return (scope & NOOK_INTERFACE_ALL_TYPES) != 0 || ((scope & NOOK_INTERFACE_PUBLIC_TYPES) != 0 && is_public);
}

/* Whether a view has something of that name, and whether that is the same. */
static void look_up(const nook_interface_view *view, const fact *wanted, bool *out_known, bool *out_same)
{
    const nook_interface *interface = view->interface;
    size_t at = hash_name(wanted->name) & (interface->slot_count - 1);
    *out_known = *out_same = false;
    for (; interface->slots[at].name; at = (at + 1) & (interface->slot_count - 1)) {
        const fact *found = &interface->slots[at];
        if (found->is_function != wanted->is_function || strcmp(found->name, wanted->name) != 0 || !sees(view, found))
            continue;
        *out_known = true;
        *out_same = *out_same || found->hash == wanted->hash;
    }
}

const char *nook_interface_difference(const nook_interface_view *earlier, const nook_interface_view *later,
                                      unsigned scope)
{
    for (size_t i = 0; i < later->interface->slot_count; i++) {
        const fact *wanted = &later->interface->slots[i];
        bool known, same;
        if (!wanted->name || !in_scope(wanted, scope) || !sees(later, wanted))
            continue;
        look_up(earlier, wanted, &known, &same);
        if (known && !same)
            return wanted->name;
    }
    return NULL;
}
