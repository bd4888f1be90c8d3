/**
 * loader.h - reads and decodes volume files on a thread, a few at once in memory. No GL.
 *
 *   start -> loading ... -> done -> the contents are used -> free
 */
#pragma once
#include "modules/bake/volume_file.h"
#include "modules/stream/stream.h"
#include <stdbool.h>

enum { LOADER_JOBS = 4 /* decoded volumes that may wait in memory */, LOADER_NONE = -1 };

typedef struct stream_loader stream_loader;

/** @return NOOK_E_MEMORY; NULL then */
nook_result stream_loader_create(stream_loader **out_loader);
void stream_loader_destroy(stream_loader *loader); /**< Waits for what is being decoded. NULL is allowed. */
/** Ends the thread, once the file that it decodes is done; jobs stay. */
void stream_loader_rest(stream_loader *loader);
/** Goes on after a rest; nothing otherwise. @return NOOK_E_MEMORY no thread */
nook_result stream_loader_wake(stream_loader *loader);
/** @param expected  what the file must hold @return the job, or LOADER_NONE: all are taken */
int stream_loader_start(stream_loader *loader, const char *path, const nook_volume_info *expected);
/** Whether it has ended; then with what, and with which contents on NOOK_OK: the loader's until it is freed. */
bool stream_loader_is_done(stream_loader *loader, int job, nook_result *out_result, nook_volume **out_contents);
/** Its contents go, and others may take the job; one that runs goes when it has ended. */
void stream_loader_free(stream_loader *loader, int job);
bool stream_loader_has_room(stream_loader *loader);
