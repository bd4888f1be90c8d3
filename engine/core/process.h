#pragma once
#include "engine/core/result.h"
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

/** What this process holds now. */
typedef struct nook_process {
    uint64_t resident; /**< Bytes of memory. */
    uint64_t
        heap; /**< Bytes that were allocated and not freed, libraries' and drivers' too; 0: the C library does not tell. */
    uint32_t files; /**< Open ones. */
} nook_process;

/** @return NOOK_E_IO the system does not tell (it has no /proc); *out is untouched then */
nook_result nook_process_read(nook_process *out);

#ifdef __cplusplus
}
#endif
