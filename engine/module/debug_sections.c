#include "engine/core/log.h"
#include "engine/module/debug_sections_internal.h"
#include <elf.h>
#include <string.h>

/* Numbers may stand at any address of the file: they are copied out. */
static bool copy_out(const nook_file *file, uint64_t offset, void *out, size_t size)
{
    if (offset > file->size || size > file->size - offset)
        return false;
    memcpy(out, file->bytes + offset, size);
    return true;
}

static bool read_header(const nook_file *file, Elf64_Ehdr *out)
{
    const uint16_t one = 1;
    const uint8_t order = *(const uint8_t *)&one ? ELFDATA2LSB : ELFDATA2MSB;
    return copy_out(file, 0, out, sizeof *out) && memcmp(out->e_ident, ELFMAG, SELFMAG) == 0 &&
           out->e_ident[EI_CLASS] == ELFCLASS64 && out->e_ident[EI_DATA] == order;
}

static bool read_section_header(const nook_file *file, const Elf64_Ehdr *header, uint64_t index, Elf64_Shdr *out)
{
    return header->e_shentsize == sizeof *out && header->e_shoff <= file->size &&
           copy_out(file, header->e_shoff + index * sizeof *out, out, sizeof *out);
}

static nook_section section_of(const nook_file *file, const Elf64_Shdr *header)
{
    bool usable = header->sh_type != SHT_NOBITS && (header->sh_flags & SHF_COMPRESSED) == 0 &&
                  header->sh_offset <= file->size && header->sh_size <= file->size - header->sh_offset;
    return usable ? (nook_section){ file->bytes + header->sh_offset, header->sh_size } : (nook_section){ NULL, 0 };
}

/* A section's name is in another one; the file ends with a zero, so that it always ends. */
static const char *name_of(nook_section names, const Elf64_Shdr *header)
{
    return header->sh_name < names.size ? (const char *)names.bytes + header->sh_name : "";
}

static void keep(nook_debug_sections *sections, const char *name, nook_section section)
{
    const struct {
        const char *name;
        nook_section *section;
    } wanted[] = { { ".debug_info", &sections->info },
                   { ".debug_abbrev", &sections->abbrev },
                   { ".debug_str", &sections->str },
                   { ".debug_line_str", &sections->line_str },
                   { ".debug_str_offsets", &sections->str_offsets } };
    for (size_t i = 0; i < NOOK_COUNT(wanted); i++) {
        if (strcmp(name, wanted[i].name) == 0)
            *wanted[i].section = section;
    }
}

static nook_result find_sections(const char *path, nook_debug_sections *sections)
{
    const nook_file *file = &sections->file;
    Elf64_Ehdr header;
    Elf64_Shdr names_header, section_header;
    if (!read_header(file, &header))
        return nook_fail(NOOK_E_FORMAT, "%s: no library or program of this kind of machine; build it again", path);
    if (!read_section_header(file, &header, header.e_shstrndx, &names_header))
        return nook_fail(NOOK_E_FORMAT, "%s: damaged, its table of sections is not in it; build it again", path);
    nook_section names = section_of(file, &names_header);
    for (uint64_t i = 0; i < header.e_shnum; i++) {
        if (!read_section_header(file, &header, i, &section_header))
            return nook_fail(NOOK_E_FORMAT, "%s: damaged, its table of sections is cut; build it again", path);
        keep(sections, name_of(names, &section_header), section_of(file, &section_header));
    }
    if (sections->info.size == 0 || sections->abbrev.size == 0)
        return nook_fail(NOOK_E_VERSION,
                         "%s: has no debug information, so that its types cannot be compared; build it with -g", path);
    return NOOK_OK;
}

nook_result nook_debug_sections_read(const char *path, nook_debug_sections *out_sections)
{
    nook_debug_sections sections = { .file = { NULL, 0 } };
    nook_result result = nook_file_read(path, &sections.file);
    if (result == NOOK_OK)
        result = find_sections(path, &sections);
    if (result == NOOK_OK)
        *out_sections = sections;
    else
        nook_file_free(&sections.file);
    return result;
}

void nook_debug_sections_free(nook_debug_sections *sections)
{
    nook_file_free(&sections->file);
    *sections = (nook_debug_sections){ .file = { NULL, 0 } };
}
