/**
 * scene.h - one fixture at one point of its parameters: geometry around a receiver at the origin with normal +z, and the truth.
 */
#pragma once
#include "engine/core/matrix.h"
#include "modules/fixture/closed_form.h"
#include "modules/fixture/mesh.h"
#include <stdbool.h>

enum { NOOK_VERIFY_OBJECTS_MAX = 6, NOOK_VERIFY_CAMERAS_MAX = 2, NOOK_VERIFY_POINT_MAX = 64 };
/* Of cameras' pictures, which are square, and of what is looked at in their middle, pixels. */
enum {
    NOOK_VERIFY_PICTURE_SIDE = 96,
    NOOK_VERIFY_LOOKED_AT_SIDE = 4,
    NOOK_VERIFY_LOOKED_AT = NOOK_VERIFY_LOOKED_AT_SIDE * NOOK_VERIFY_LOOKED_AT_SIDE,
    NOOK_VERIFY_LOOKED_AT_FROM = (NOOK_VERIFY_PICTURE_SIDE - NOOK_VERIFY_LOOKED_AT_SIDE) / 2
};

/** Looks at the receiver. */
typedef struct nook_verify_camera {
    const char *name; /**< "above"; NULL: none. */
    double eye[3];    /**< Metres. */
    double angle;     /**< Field of view, radians. */
} nook_verify_camera;

typedef struct nook_verify_scene {
    char point[NOOK_VERIFY_POINT_MAX]; /**< "k 0.4, linear" */
    nook_falloff falloff;
    double r_max;                                       /**< Metres. */
    double tau;                                         /**< Of the exponential falloff. */
    double truth[2];                                    /**< By nook_form_weight. */
    nook_fixture_mesh objects[NOOK_VERIFY_OBJECTS_MAX]; /**< What occludes. */
    uint32_t object_count;
    /** Drawn for cameras, and no occluder: the receiver's own plane, and what makes a wall the side of something solid. */
    nook_fixture_mesh ground;
    uint32_t resolution; /**< Of volumes, voxels along the longest side. */
    nook_verify_camera cameras[NOOK_VERIFY_CAMERAS_MAX];
    /**
     * In every direction all rays from the floor up to the highest that is blocked are blocked, so that a horizon says all: what
     * techniques that look for horizons can be held to.
     */
    bool height_field;
} nook_verify_scene;

/* How far what the closed form calls infinite reaches in a scene, metres. */
#define NOOK_VERIFY_INFINITE 1e4 /**< What lies beyond has a solid angle under 1e-3. Truth: the infinite form. */
#define NOOK_VERIFY_VOXELS 3.0   /**< For voxels, which grow with what they cover. Truth: of the piece, exactly. */
#define NOOK_VERIFY_PICTURE 2.0  /**< For cameras, which must see it all. The same. */

/** One row of docs/techniques.md, section Fixtures. */
typedef struct nook_verify_fixture {
    const char *name; /**< [a-z_]+, for the command line. */
    const char *what; /**< One line for the table. */
    /** Fills a scene whose ground is a floor, r_max 1, falloff hard, tau 3, no cameras. @param point  below `points` */
    void (*make)(uint32_t point, double extent, nook_verify_scene *scene);
    int row;
    uint32_t points;        /**< Of its parameters. */
    uint32_t camera_points; /**< The first so many are seen by all cameras, the rest by the first; ... */
    uint32_t quick_points;  /**< ... go into a quick run. */
} nook_verify_fixture;

/** Rows 1 to 17 that are geometry, in their order. */
const nook_verify_fixture *nook_verify_fixtures(size_t *out_count);

/** Makes the scene; free it. @param extent  NOOK_VERIFY_* */
void nook_verify_scene_make(const nook_verify_fixture *fixture, uint32_t point, double extent,
                            nook_verify_scene *out_scene);
void nook_verify_scene_free(nook_verify_scene *scene);

/** View from world: it looks at the receiver. */
nook_matrix nook_verify_camera_matrix(const nook_verify_camera *camera);

/* ---- For the fixtures' own files -------------------------------------------------------------------------------- */

/** The next object, empty. */
nook_fixture_mesh *nook_verify_scene_object(nook_verify_scene *scene);
/** Adds a parallelogram to an object, and what it occludes to the truths: only for faces that do not hide one another. */
void nook_verify_scene_face(nook_verify_scene *scene, nook_fixture_mesh *object, const double corner[3],
                            const double edge_u[3], const double edge_v[3]);
void nook_verify_scene_truth(nook_verify_scene *scene, double cosine, double solid_angle);
/** r_max a little beyond all corners of the objects, so that a hard falloff cuts nothing. */
void nook_verify_scene_reach_all(nook_verify_scene *scene);
void nook_verify_scene_camera(nook_verify_scene *scene, const char *name, const double eye[3], double angle);
/** The names of ao.falloff. */
const char *nook_verify_falloff_name(nook_falloff falloff);
