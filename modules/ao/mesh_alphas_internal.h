/** mesh_alphas_internal.h - a mesh's own copy of what of it is not opaque; inside modules/ao only. */
#pragma once
#include "engine/core/alpha.h"

typedef struct ao_mesh_alphas ao_mesh_alphas;

/** Copies alphas alone, not colours, and once what parts share. @param alphas  sound, not NULL @return NULL when there is no memory */
ao_mesh_alphas *ao_mesh_alphas_create(const nook_alphas *alphas, uint32_t vertex_count);
void ao_mesh_alphas_destroy(ao_mesh_alphas *copy);                 /**< NULL is allowed. */
const nook_alphas *ao_mesh_alphas_get(const ao_mesh_alphas *copy); /**< NULL for NULL. */
