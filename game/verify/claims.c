#include "game/verify/claims.h"
#include <string.h>

static const nook_verify_claim claims[] = {
    { .name = "reference",
      .technique = "reference",
      .target = NOOK_VERIFY_EQUATION_1,
      .tolerance = 0.005,
      .settings = "reference rays=4096",
      .says = "equation 1, by rays against the triangles" },
    { .name = "volume",
      .technique = "volume",
      .target = NOOK_VERIFY_EQUATION_1,
      .tolerance = 0.02,
      .plane = 1.0 / 255,
      .settings = "volume rays=1024 steps=1024 ao.filter=none",
      .says = "equation 1, to what voxels can hold" },
    { .name = "volume.surfel",
      .technique = "volume",
      .initial = "volume kind=surfel",
      .target = NOOK_VERIFY_EQUATION_1,
      .tolerance = 0.01,
      .plane = 0.0,
      .settings = "volume kind=surfel rays=1024 ao.filter=none",
      .says = "equation 1, to what planes in voxels can hold" },
    { .name = "volume.density",
      .technique = "volume",
      .initial = "volume kind=density",
      .target = NOOK_VERIFY_EQUATION_1,
      .tolerance = 0.03,
      .plane = 0.0,
      .settings = "volume kind=density rays=1024 ao.filter=none",
      .says = "equation 1, to what voxels walked one by one can hold" },
    { .name = "volume.distance",
      .technique = "volume",
      .initial = "volume kind=distance",
      .target = NOOK_VERIFY_EQUATION_1,
      .tolerance = 0.03,
      .plane = 0.0,
      .settings = "volume kind=distance rays=1024 ao.filter=none",
      .says = "equation 1, to half a voxel around surfaces" },
    { .name = "hao",
      .technique = "hao",
      .target = NOOK_VERIFY_EQUATION_1,
      .tolerance = 0.03, /* measured, not derived: docs/measuring.md, Verify */
      .plane = 0.0,
      .settings = "hao rays=256 tests=256 slicemaps=three noise=tile ao.filter=none",
      .says = "equation 1, to what voxels around the view can hold" },
    { .name = "hsao",
      .technique = "hsao",
      .target = NOOK_VERIFY_EQUATION_1,
      .tolerance = 0.04,
      .plane = 0.01,
      .reads_picture = true,
      .horizons = true,
      .samples = 16, /* one ray above the horizon in each direction */
      .settings = "hsao directions=16 steps=48 rays=1 ray_steps=24 ao.filter=none",
      .says = "equation 1, of what the depth buffer holds" },
    { .name = "gtao",
      .technique = "gtao",
      .target = NOOK_VERIFY_EQUATION_1,
      .tolerance = 0.03,
      .plane = 0.01,
      .reads_picture = true,
      .horizons = true,
      .settings = "gtao slices=16 steps=48 ao.filter=none",
      .says = "equation 1, of what the depth buffer holds" },
    { .name = "hbao",
      .technique = "hbao",
      .target = NOOK_VERIFY_SOLID_ANGLE,
      .tolerance = 0.03,
      .plane = 0.01,
      .reads_picture = true,
      .horizons = true,
      .settings = "hbao directions=32 steps=48 ao.filter=none",
      .says = "the solid angle below the horizon, without the cosine (erratum C18)" },
    { .name = "ssao",
      .technique = "ssao",
      .target = NOOK_VERIFY_HALF_BALL,
      .tolerance = 0.03,
      .plane = 0.01,
      .reads_picture = true,
      .samples = 512,
      .settings = "ssao samples=512 ao.filter=none",
      .says = "the part of the half ball of radius r_max that the depth buffer hides" },
};

static const char ASKEW_SETTINGS[] = "volume rays=1024 steps=1024 threshold=0.4 stepping=fixed ao.filter=none";
static const char ASKEW[] = "an open sheet askew in its voxels needs a lower threshold and short steps";

static const char CLOSE_TESTS[] = "hao rays=256 tests=256 voxels=128 slicemaps=three noise=tile ao.filter=none";
static const char CLOSER_TESTS[] = "hao rays=256 tests=256 voxels=80 slicemaps=three noise=tile ao.filter=none";
static const char CLOSE[] =
    "a sheet askew marks as little as 0.58 of a layer of voxels: tests must be closer than that";

static const nook_verify_exception exceptions[] = {
    { "volume", "dihedral", "", ASKEW_SETTINGS, 0.0, ASKEW },
    { "volume", "pit", "", ASKEW_SETTINGS, 0.0, ASKEW },
    { "volume", "sphere_inside", "", ASKEW_SETTINGS, 0.0, ASKEW },
    { "hao", "sphere_inside", "", CLOSER_TESTS, 0.04, CLOSE },
    { "hao", "pit", "", CLOSE_TESTS, 0.0, CLOSE },
    { "ssao", "ceiling", "k 0.1, hard", NULL, 0.0,
      "a slit five pixels high: points share texels with what hides them" },
};

const nook_verify_claim *nook_verify_claim_of(const char *name)
{
    for (size_t i = 0; i < sizeof claims / sizeof *claims; i++) {
        if (strcmp(claims[i].name, name) == 0)
            return &claims[i];
    }
    return NULL;
}

const nook_verify_claim *nook_verify_claim_at(const char *technique, size_t index)
{
    for (size_t i = 0; i < sizeof claims / sizeof *claims; i++) {
        if (strcmp(claims[i].technique, technique) == 0 && index-- == 0)
            return &claims[i];
    }
    return NULL;
}

const nook_verify_exception *nook_verify_exception_for(const char *claim, const char *fixture, const char *point)
{
    for (size_t i = 0; i < sizeof exceptions / sizeof *exceptions; i++) {
        const nook_verify_exception *e = &exceptions[i];
        if (strcmp(e->claim, claim) == 0 && strcmp(e->fixture, fixture) == 0 &&
            strncmp(e->point, point, strlen(e->point)) == 0)
            return e;
    }
    return NULL;
}

const char *nook_verify_target_name(nook_verify_target target)
{
    static const char *const names[] = { "Eq. 1", "own: solid angle", "own: half ball" };
    return names[target];
}
