#include "tests/support/file_tree.h"
#include "engine/core/file.h"
#include "tests/support/scratch.h"
#include <dirent.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cmocka.h> /* wants those above first */

enum { PATH_CAPACITY = 1024 };

/* A file, a link, or a folder with all in it; what is not there is no matter. */
static void remove_all(const char *path)
{
    struct stat info;
    char inner[PATH_CAPACITY];
    const struct dirent *entry;
    if (lstat(path, &info) != 0)
        return;
    DIR *directory = S_ISDIR(info.st_mode) ? opendir(path) : NULL;
    while (directory && (entry = readdir(directory)) != NULL) {
        if (strcmp(entry->d_name, ".") != 0 && strcmp(entry->d_name, "..") != 0)
            remove_all(nook_path_join(inner, sizeof inner, path, entry->d_name));
    }
    if (directory)
        closedir(directory);
    assert_int_equal(remove(path), 0);
}

void file_tree_begin(file_tree *tree, const char *name)
{
    nook_scratch_path(tree->root, sizeof tree->root, name);
    remove_all(tree->root);
    assert_int_equal(nook_directory_make(tree->root), NOOK_OK);
}

const char *file_tree_path(const file_tree *tree, const char *path, char *out, size_t capacity)
{
    return nook_path_join(out, capacity, tree->root, path);
}

static void write_file(const char *path, const char *text)
{
    FILE *file = fopen(path, "w");
    assert_non_null(file);
    fputs(text, file);
    assert_int_equal(fclose(file), 0);
}

static void make_folder_of(const char *path)
{
    char folder[PATH_CAPACITY];
    snprintf(folder, sizeof folder, "%.*s", (int)(nook_path_name(path) - path - 1), path);
    assert_int_equal(nook_directory_make(folder), NOOK_OK);
}

void file_tree_write(const file_tree *tree, const char *path, const char *text)
{
    char full[PATH_CAPACITY];
    make_folder_of(file_tree_path(tree, path, full, sizeof full));
    write_file(full, text);
}

void file_tree_replace(const file_tree *tree, const char *path, const char *text)
{
    char full[PATH_CAPACITY], fresh[PATH_CAPACITY + 8];
    file_tree_path(tree, path, full, sizeof full);
    snprintf(fresh, sizeof fresh, "%s.new", full);
    write_file(fresh, text);
    assert_int_equal(rename(fresh, full), 0);
}

static void copy_all(const char *from, const char *to)
{
    char inner_from[PATH_CAPACITY], inner_to[PATH_CAPACITY];
    const struct dirent *entry;
    DIR *directory = nook_directory_exists(from) ? opendir(from) : NULL;
    if (!directory) {
        assert_int_equal(nook_file_copy(from, to), NOOK_OK);
        return;
    }
    assert_int_equal(nook_directory_make(to), NOOK_OK);
    while ((entry = readdir(directory)) != NULL) {
        if (entry->d_name[0] != '.')
            copy_all(nook_path_join(inner_from, sizeof inner_from, from, entry->d_name),
                     nook_path_join(inner_to, sizeof inner_to, to, entry->d_name));
    }
    closedir(directory);
}

void file_tree_copy(const file_tree *tree, const char *root, const char *path)
{
    char from[PATH_CAPACITY], to[PATH_CAPACITY];
    make_folder_of(file_tree_path(tree, path, to, sizeof to));
    copy_all(nook_path_join(from, sizeof from, root, path), to);
}

void file_tree_edit(const file_tree *tree, const char *path, const char *before, const char *after)
{
    char full[PATH_CAPACITY];
    nook_file file;
    assert_int_equal(nook_file_read(file_tree_path(tree, path, full, sizeof full), &file), NOOK_OK);
    const char *text = (const char *)file.bytes, *at = strstr(text, before);
    assert_non_null(at);
    size_t size = file.size - strlen(before) + strlen(after) + 1;
    char *edited = malloc(size);
    assert_non_null(edited);
    snprintf(edited, size, "%.*s%s%s", (int)(at - text), text, after, at + strlen(before));
    file_tree_replace(tree, path, edited);
    free(edited);
    nook_file_free(&file);
}

void file_tree_remove(const file_tree *tree, const char *path)
{
    char full[PATH_CAPACITY];
    remove_all(file_tree_path(tree, path, full, sizeof full));
}

int file_tree_open_files(void)
{
    DIR *directory = opendir("/proc/self/fd");
    int count = -3; /* "." and ".." and the folder itself */
    assert_non_null(directory);
    while (readdir(directory))
        count++;
    closedir(directory);
    return count;
}

long file_tree_resident_kb(void)
{
#ifdef __SANITIZE_ADDRESS__
    return 0;
#else
    long pages = 0;
    FILE *file = fopen("/proc/self/statm", "r");
    assert_non_null(file);
    assert_int_equal(fscanf(file, "%*s %ld", &pages), 1);
    fclose(file);
    return pages * (sysconf(_SC_PAGE_SIZE) / 1024);
#endif
}
