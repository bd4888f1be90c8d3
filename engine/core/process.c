#include "engine/core/process.h"
#include "engine/core/log.h"
#include <dirent.h>
#if defined(__GLIBC__)
#include <malloc.h>
#endif
#include <stdbool.h>
#include <stdio.h>
#include <unistd.h>

static bool read_resident(uint64_t *out)
{
    unsigned long long total, resident;
    FILE *file = fopen("/proc/self/statm", "r");
    if (!file)
        return false;
    bool read = fscanf(file, "%llu %llu", &total, &resident) == 2;
    fclose(file);
    if (read)
        *out = resident * (uint64_t)sysconf(_SC_PAGESIZE);
    return read;
}

/* What allocators keep of what was freed, and tear to pieces, is no part of this. */
static uint64_t count_heap(void)
{
#if defined(__GLIBC__) && (__GLIBC__ > 2 || __GLIBC_MINOR__ >= 33)
    struct mallinfo2 info = mallinfo2();
    return (uint64_t)info.uordblks + (uint64_t)info.hblkhd;
#else
    return 0;
#endif
}

static bool count_files(uint32_t *out)
{
    uint32_t count = 0;
    DIR *folder = opendir("/proc/self/fd");
    if (!folder)
        return false;
    for (const struct dirent *entry = readdir(folder); entry; entry = readdir(folder))
        count += entry->d_name[0] != '.';
    closedir(folder);
    *out = count - 1; /* the folder itself was one of them */
    return true;
}

nook_result nook_process_read(nook_process *out)
{
    nook_process process = { .heap = count_heap() };
    if (!read_resident(&process.resident) || !count_files(&process.files))
        return nook_fail(NOOK_E_IO, "/proc/self: what this process holds cannot be read here");
    *out = process;
    return NOOK_OK;
}
