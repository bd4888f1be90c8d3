#include "game/measure/truth_file.h"
#include "engine/core/file.h"
#include "engine/core/log.h"
#include <stdlib.h>
#include <string.h>
#include <xxhash.h>

/* In the machine's byte order: the magic number reads differently on another. */
typedef struct header {
    uint32_t magic, version;
    uint32_t width, height;
    uint32_t batch_rays, batches;
    uint64_t key;      /* what it is the truth of */
    uint64_t checksum; /* of the sums behind the header: first those of the even batches, then those of the odd */
} header;

enum { MAGIC = 0x5552544E /* "NTRU" */ };

static size_t half_size(const nook_truth *truth)
{
    return (size_t)truth->width * truth->height * sizeof(float);
}

/* @return what is wrong with it, or NULL */
static const char *find_fault(const nook_truth *truth, const nook_file *file, header *out_header)
{
    size_t sums = 2 * half_size(truth);
    if (file->size != sizeof *out_header + sums)
        return "its size is wrong";
    memcpy(out_header, file->bytes, sizeof *out_header);
    if (out_header->magic != MAGIC || out_header->version != NOOK_TRUTH_VERSION)
        return "it is no truth of this version and byte order";
    if (out_header->key != truth->key || out_header->width != truth->width || out_header->height != truth->height ||
        out_header->batch_rays != truth->batch_rays)
        return "it is of another picture";
    if (out_header->batches == 0 || out_header->batches % 2 != 0)
        return "its count of batches is wrong";
    if (XXH3_64bits(file->bytes + sizeof *out_header, sums) != out_header->checksum)
        return "its checksum is wrong";
    return NULL;
}

bool nook_truth_file_read(nook_truth *truth)
{
    nook_file file;
    header head;
    if (truth->path[0] == '\0' || !nook_file_exists(truth->path))
        return false;
    if (nook_file_read(truth->path, &file) != NOOK_OK)
        return false;
    const char *fault = find_fault(truth, &file, &head);
    if (fault) {
        nook_log_warning("%s: a damaged truth (%s); it is traced anew", truth->path, fault);
    } else {
        memcpy(truth->sums[0], file.bytes + sizeof head, half_size(truth));
        memcpy(truth->sums[1], file.bytes + sizeof head + half_size(truth), half_size(truth));
        truth->batches = head.batches;
    }
    nook_file_free(&file);
    return !fault;
}

void nook_truth_file_write(nook_truth *truth)
{
    if (truth->path[0] == '\0' || truth->warned)
        return;
    size_t half = half_size(truth);
    uint8_t *bytes = malloc(sizeof(header) + 2 * half);
    int reason = bytes ? 0 : -1;
    if (bytes) {
        memcpy(bytes + sizeof(header), truth->sums[0], half);
        memcpy(bytes + sizeof(header) + half, truth->sums[1], half);
        const header head = { MAGIC,
                              NOOK_TRUTH_VERSION,
                              truth->width,
                              truth->height,
                              truth->batch_rays,
                              truth->batches,
                              truth->key,
                              XXH3_64bits(bytes + sizeof(header), 2 * half) };
        memcpy(bytes, &head, sizeof head);
        reason = nook_file_try_write(truth->path, bytes, sizeof head + 2 * half);
    }
    free(bytes);
    if (reason != 0) {
        nook_log_warning("%s: cannot keep the truth there: %s; it is traced each time", truth->path,
                         reason > 0 ? strerror(reason) : "no memory");
        truth->warned = true;
    }
}
