#include "game/extremes/probe.h"
#include "engine/core/log.h"
#include "modules/fixture/view.h"
#include <stdlib.h>

void nook_probe_free(nook_probe *probe)
{
    free(probe->depth);
    free(probe->normals);
    free(probe->occluders);
    *probe = (nook_probe){ 0 };
}

void nook_probe_normal(const nook_probe *probe, size_t pixel, double out_normal[3])
{
    const float texel[2] = { (float)probe->normals[pixel][0] / 65535.0f, (float)probe->normals[pixel][1] / 65535.0f };
    nook_fixture_decode_normal(texel, out_normal);
}

/** The visibility, all 1, is written from the block that then keeps the depth. */
static nook_result keep(const nook_ao_pass *pass, nook_probe *probe)
{
    size_t pixels = (size_t)pass->width * pass->height, size = pass->occluder_count * sizeof *probe->occluders;
    nook_probe_free(probe);
    probe->depth = malloc(pixels * sizeof *probe->depth);
    probe->normals = malloc(pixels * sizeof *probe->normals);
    probe->occluders = malloc(size ? size : 1);
    if (!probe->depth || !probe->normals || !probe->occluders)
        return nook_fail(NOOK_E_MEMORY, "probe: no room for %zu pixels", pixels);
    probe->width = pass->width, probe->height = pass->height;
    probe->occluder_count = pass->occluder_count;
    for (size_t i = 0; i < pixels; i++)
        probe->depth[i] = 1.0f;
    nook_texture_write(pass->gpu, pass->visibility, GL_RED, GL_FLOAT, probe->depth, pixels * sizeof *probe->depth);
    nook_texture_read(pass->gpu, pass->depth, GL_RED, GL_FLOAT, probe->depth, pixels * sizeof *probe->depth);
    nook_texture_read(pass->gpu, pass->normal, GL_RG, GL_UNSIGNED_SHORT, probe->normals,
                      pixels * sizeof *probe->normals);
    if (size)
        nook_buffer_read(pass->gpu, pass->occluders, 0, probe->occluders, size);
    return NOOK_OK;
}

static nook_result record(void *state, const void *params, const nook_ao_pass *pass)
{
    (void)state, (void)params;
    return keep(pass, pass->progress_user);
}

const nook_ao_technique nook_probe_technique = {
    .version = NOOK_AO_TECHNIQUE_VERSION,
    .name = "probe",
    .summary = "Keeps what techniques are given",
    .inputs = NOOK_AO_IN_VOLUMES,
    .state_version = 1,
    .record = record,
};
