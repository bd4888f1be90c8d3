/** stream_volumes.h - the world's volumes in a stream (modules/stream): its bodies' files, and a camera's view. */
#pragma once
#include "engine/render/renderer.h"
#include "game/volumes.h"
#include "modules/stream/stream.h"

/** Whether all kinds that a volume was baked in can be streamed: they are in the cache, and it was baked for it. */
bool nook_volume_can_stream(const nook_scene_volume *baked);
/**
 * Adds a volume's files of one kind to a stream.
 * @param volume  id 0: a new one, which is written there @return as nook_stream_add and nook_stream_extend
 */
nook_result nook_volume_stream(nook_stream *stream, const nook_scene_volume *baked, nook_volume_kind kind,
                               nook_ao_volume *volume);
/** A frame's work of a stream, for one camera. @return as nook_stream_update */
nook_result nook_stream_look(nook_stream *stream, const nook_camera *camera, const nook_matrix *clip_from_view,
                             const nook_ao_occluder *occluders, uint32_t count);
/** "volumes: 3.10 of 8.00 MiB, 20 of 23 there, 20 wanted, 3 of these waiting". @return out */
const char *nook_stream_print(const nook_stream *stream, char *out, size_t capacity);
