#include "tests/support/module_build.h"
#include "engine/core/file.h"
#include "tests/support/test_gpu.h"
#include <dirent.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <cmocka.h>

#ifdef __SANITIZE_ADDRESS__
static const char flags[] = "-O1 -fsanitize=address,undefined -fno-sanitize-recover=all";
#else
static const char flags[] = "-O2";
#endif

void module_build(const char *folder, const char *name, const char *source, const char *options)
{
    char command[4096];
    snprintf(command, sizeof command,
             "cd '%s' && ${CC:-cc} -std=c11 -g %s -fPIC -shared -D_DEFAULT_SOURCE -DCGLM_ALL_UNALIGNED -I. %s '%s' "
             "-o '%s/%s.so.aside' && mv '%s/%s.so.aside' '%s/%s.so'",
             test_gpu_root(), flags, options, source, folder, name, folder, name, folder, name);
    if (system(command) != 0)
        fail_msg("%s", command);
}

void module_put(const char *folder, const char *name, const char *path)
{
    char to[4096];
    nook_file file;
    snprintf(to, sizeof to, "%s/%s.so", folder, name);
    assert_int_equal(nook_file_read(path, &file), NOOK_OK);
    assert_int_equal(nook_file_write(to, file.bytes, file.size), NOOK_OK);
    nook_file_free(&file);
}

void module_publish(const char *folder, const char *text)
{
    static int number; /* two builds in one tick of the file system's clock differ by their size or their node */
    char path[4096], build[4096];
    nook_path_join(path, sizeof path, folder, "build");
    int length = snprintf(build, sizeof build, "%d %s", ++number, text);
    assert_int_equal(nook_file_write(path, build, (size_t)length), NOOK_OK);
}

int module_count_files(const char *folder, const char *part)
{
    int count = 0;
    DIR *directory = opendir(folder);
    assert_non_null(directory);
    for (const struct dirent *entry = readdir(directory); entry; entry = readdir(directory))
        count += strstr(entry->d_name, part) != NULL;
    closedir(directory);
    return count;
}
