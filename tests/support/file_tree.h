/**
 * file_tree.h - a scratch folder of files that tests write as editors do, and what this process holds.
 */
#pragma once
#include <stddef.h>

typedef struct file_tree {
    char root[512];
} file_tree;

/** An empty folder of that name in the program's scratch folder. */
void file_tree_begin(file_tree *tree, const char *name);

/** root/path. @return out */
const char *file_tree_path(const file_tree *tree, const char *path, char *out, size_t capacity);

/** Writes over the bytes of the file that is there, as some editors save. Makes its folder. */
void file_tree_write(const file_tree *tree, const char *path, const char *text);
/** Writes a new file and renames it over the old one, as most editors save. */
void file_tree_replace(const file_tree *tree, const char *path, const char *text);
/** Puts a copy of a file, or of a folder with all in it, under the same path. @param root where it is copied from */
void file_tree_copy(const file_tree *tree, const char *root, const char *path);
/** Puts `after` in the place of `before`, which must stand in the file, and saves it as file_tree_replace does. */
void file_tree_edit(const file_tree *tree, const char *path, const char *before, const char *after);
/** Deletes a file, or a folder with all in it. */
void file_tree_remove(const file_tree *tree, const char *path);

/** Open files of this process. */
int file_tree_open_files(void);
/** Memory of this process, kilobytes; 0 under AddressSanitizer, which keeps what is freed and looks for leaks itself. */
long file_tree_resident_kb(void);
