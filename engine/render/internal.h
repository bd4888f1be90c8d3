/** internal.h - what the passes of engine/render share among themselves. Nobody outside includes it. */
#pragma once
#include "engine/render/renderer.h"

/** Binding numbers; shaders repeat them at their top (docs/rendering.md). */
enum {
    UNIT_BASE_COLOUR_IMAGE = 0,
    UNIT_METALLIC_ROUGHNESS_IMAGE,
    UNIT_NORMAL_IMAGE,
    UNIT_EMISSIVE_IMAGE,
    UNIT_OCCLUSION_IMAGE,
    UNIT_SHADOW,
    UNIT_BASE_COLOUR,
    UNIT_NORMAL,
    UNIT_GEOMETRIC_NORMAL,
    UNIT_MATERIAL,
    UNIT_EMISSIVE,
    UNIT_DEPTH,
    UNIT_VISIBILITY,
    UNIT_LIGHT,
    UNIFORM_FRAME = 0,
    UNIFORM_LIGHTS = 1,
    UNIFORM_MATERIAL = 2,
    STORAGE_TRIANGLE_NORMALS = 2,
    LOCATION_DRAW = 0,
    ATTRIBUTE_INSTANCE = 5,
    VERTEX_STREAM = 0,
    INSTANCE_STREAM = 1,
    SHADOW_SIZE = 2048, /* texels on a side */
};

/** Per instance, as vertex attributes 5 to 11. */
typedef struct instance_data {
    float view_from_mesh[16];
    float world_normal_from_mesh[3][4]; /* columns; w of the first: -1 when the transform mirrors, else 1 */
} instance_data;

/** Uniform block "Frame", std140. */
typedef struct frame_block {
    float clip_from_view[16];
    float world_from_view[16];      /* rotation only: to relative space */
    float shadow_from_relative[16]; /* to [0, 1]^3 of the shadow map */
    float ray_scale[2];             /* view ray = (ndc * ray_scale, -1) */
    float z_near;
    float shadow_texel;          /* metres */
    float depth_near, depth_far; /* metres, for the depth view */
    float size[2];               /* pixels */
} frame_block;

/** Uniform block "Lights", std140; everything exposed, positions in relative space. */
typedef struct lights_block {
    float sun_direction[4]; /* towards the sun, unit; w: 1 when there is a sun */
    float sun_colour[4];
    float ambient_top[4];
    float ambient_bottom[4];
    uint32_t point_count[4]; /* x */
    struct {
        float position_fade[4];   /* w: one over the range squared, 0: unbounded */
        float colour_inner[4];    /* w: cosine of the inner angle */
        float direction_outer[4]; /* w: cosine of the outer angle; direction 0: not a spot */
    } points[NOOK_MAX_POINT_LIGHTS];
} lights_block;

/** A primitive as uploaded. */
typedef struct render_primitive {
    uint32_t first_index, index_count;
    uint32_t first_vertex;
    uint32_t first_triangle; /* into the triangle normals */
    uint32_t material;
    float centre[3]; /* mesh space, for sorting */
} render_primitive;

enum {
    MATERIAL_IMAGES = 5,
    IMAGE_SETS = 1 << MATERIAL_IMAGES,
    MATERIAL_STRIDE = 256 /* the most that GL asks of an offset */
};

/** A material's textures; id 0 where it has none. */
typedef struct render_material {
    nook_texture images[MATERIAL_IMAGES]; /* by UNIT_*_IMAGE */
    uint32_t image_set;                   /* bits: 1 << UNIT_*_IMAGE of those it has */
    bool emits;
} render_material;

/** What deformables need on the GPU; zero in a scene without them. Their vertices stand one after the other in these. */
typedef struct render_deform {
    nook_program program, normals_program;
    nook_buffer rest, posed;        /* nook_vertex */
    nook_buffer influences, deltas; /* as in the scene */
    nook_buffer joints, weights;    /* of the pose */
    nook_buffer indices, normals;   /* of their primitives, in order */
    uint32_t version;               /* of the pose that the scene's vertices have; 0: none yet */
} render_deform;

/** A list that grows and never shrinks. */
typedef struct grow_list {
    void *items;
    size_t capacity; /* bytes */
} grow_list;

enum { CHUNK_TRIANGLES = 64 };

/** Triangles of a primitive that follow each other: what a quick frame looks at at once. */
typedef struct render_chunk {
    nook_box box;          /* mesh space, at rest */
    uint32_t first_vertex; /* into the vertices of all chunks */
    uint32_t first_triangle;
    uint32_t vertex_count, triangle_count;
} render_chunk;

/** All triangles of a scene by chunks; made when the first quick frame asks for them. */
typedef struct render_chunks {
    uint32_t *first; /* by primitive, and one more: its first chunk. NULL: none made yet */
    render_chunk *items;
    float *x, *y, *z;      /* by vertex: mesh space */
    uint32_t *indices;     /* by vertex: relative to the primitive's first */
    uint8_t (*corners)[3]; /* by triangle: vertices of the chunk */
} render_chunks;

struct nook_render_scene {
    nook_gpu *gpu;
    render_deform deform;
    const nook_scene *scene; /* borrowed */
    nook_buffer vertices, indices, triangle_normals;
    nook_buffer materials;            /* one every MATERIAL_STRIDE bytes */
    bool has_tangents, has_colours;   /* some vertex has; a colour that is not white */
    render_primitive *primitives;     /* as scene->primitives */
    render_material *material_images; /* as scene->materials */
    nook_texture *textures;           /* owned: every image that is used, once per encoding */
    uint32_t texture_count;
    render_chunks chunks;
    uint64_t bytes;
    double created_ms; /* tells this scene from an older one at the same address */
};

/** Instances of one mesh, and of one handedness, that follow each other in the instance buffer. */
typedef struct batch {
    uint32_t mesh;
    uint32_t first_instance, instance_count;
    bool mirrored; /* its triangles wind the other way */
    double order;  /* of its first instance */
} batch;

/** A draw that is in view, and where. */
typedef struct kept_draw {
    uint32_t draw, bucket; /* bucket: mesh and handedness */
    double order;          /* where its box begins, or ends, along the view axis; 0 when nothing is culled */
} kept_draw;

/** One blended primitive of one instance. */
typedef struct blended_draw {
    double distance; /* along the view axis */
    uint32_t primitive, instance;
    bool mirrored;
} blended_draw;

/** What one pass draws: instances in a GPU buffer, and runs of them. */
typedef struct draw_set {
    grow_list unsorted;  /* instance_data, in the order of the draws */
    grow_list kept;      /* kept_draw: those in view, in order */
    grow_list instances; /* instance_data */
    grow_list draws;     /* uint32_t: which draw an instance is */
    grow_list batches;   /* batch, in order, nearest first: what lies behind is not shaded */
    grow_list counts;    /* uint32_t: draws per mesh and handedness */
    uint32_t instance_count, batch_count;
    double near_distance, far_distance; /* along the view axis, of the boxes of what is in it; near > far when empty */
    nook_buffer buffer;                 /* the instances on the GPU */
} draw_set;

/** Pixels; both ends are inside. */
typedef struct pixel_rect {
    uint16_t low[2], high[2];
} pixel_rect;

/** Indices of one instance of one primitive that are drawn. */
typedef struct index_range {
    uint32_t first, count;
} index_range;

/** Triangles to be drawn. */
typedef struct index_list {
    grow_list indices;  /* uint32_t */
    grow_list ranges;   /* index_range: by draw, primitive of its mesh */
    uint32_t count;     /* of indices */
    nook_buffer buffer; /* the indices on the GPU */
} index_list;

/** What a quick frame leaves out: triangles that show nothing. */
typedef struct triangle_cull {
    bool on;                        /* in this frame */
    const nook_render_scene *scene; /* that `kept` and `seen` are of, and when that was made */
    double scene_created_ms;
    grow_list meshes;      /* uint32_t, by draw: those that they are of */
    grow_list first_seen;  /* uint32_t, by draw: where its triangles begin in `seen` */
    grow_list first_range; /* uint32_t, by draw: where its primitives begin in the ranges of lists */
    grow_list candidates;  /* cull_candidate: triangles that have pixels, in the order in which they are drawn */
    grow_list seen;        /* uint8_t: whether `kept` has it, of all triangles of all draws */
    grow_list next_seen;
    grow_list depths; /* float: the picture's, bottom row first */
    index_list kept;  /* what could be seen in the last frame */
    index_list rest;  /* what else can be seen */
    size_t draw_count;
    uint32_t candidate_count, seen_count, range_count;
} triangle_cull;

/** All targets that depend on the size. */
typedef struct render_targets {
    nook_gbuffer gbuffer;
    nook_texture light, image;
    nook_framebuffer gbuffer_target, dark_gbuffer_target; /* dark: without emission */
    nook_framebuffer light_target, blended_target, image_target;
} render_targets;

/** A box in the sun's axes: x, y across, z away from the sun. In double: it is not relative to the camera, which moves. */
typedef struct sun_box {
    double low[3], high[3];
} sun_box;

/** Where the sun's shadow map lies in the world. */
typedef struct shadow_fit {
    nook_matrix sun_from_world, map_from_world; /* map: [0, 1]^3 */
    sun_box box;                                /* what the map has room for */
    double texel;                               /* metres */
} shadow_fit;

/** Part of the shadow map, texels: low inside, high outside. */
typedef struct shadow_rect {
    int32_t low[2], high[2];
} shadow_rect;

enum { SHADOW_RECTS = 8 };

/** Parts of the map that show what has changed. */
typedef struct shadow_rects {
    shadow_rect items[SHADOW_RECTS];
    uint32_t count;
} shadow_rects;

/** What the shadow map holds, to tell what of it must be drawn again. */
typedef struct shadow_contents {
    const nook_render_scene *scene; /* NULL: nothing */
    double scene_created_ms;
    double sun_direction[3];
    grow_list draws; /* nook_draw */
    grow_list some;  /* nook_draw: those of one part */
    size_t draw_count;
    shadow_fit fit;
    uint32_t program_version; /* of the programs that drew it */
    bool has_base;            /* the base map holds all draws that do not move */
} shadow_contents;

/** What G-buffer programs are compiled for, besides a material's images. */
enum { GBUFFER_MASKED = 1, GBUFFER_QUICK = 2, GBUFFER_NO_TANGENTS = 4, GBUFFER_NO_COLOURS = 8, GBUFFER_KINDS = 16 };

struct nook_renderer {
    nook_gpu *gpu;
    uint32_t width, height;
    render_targets targets;
    nook_texture shadow_map, shadow_base; /* the base is made when something first moves */
    nook_framebuffer shadow_target, shadow_base_target;
    shadow_contents shadow;
    nook_texture white;
    nook_buffer frame_uniforms, light_uniforms;
    uint32_t vertex_array;
    uint32_t empty_vertex_array; /* for full-screen triangles */
    nook_program shadow_program, shadow_masked_program, gbuffer_program, gbuffer_masked_program; /* for any material */
    nook_program gbuffer_programs[GBUFFER_KINDS][IMAGE_SETS]; /* id 0 until one is drawn with */
    uint32_t quick_sampler;                                   /* of material images in a quick frame */
    uint32_t nearest_sampler;                                 /* of the caller's visibility */
    nook_program lighting_program, lighting_image_program, blended_program, view_program;
    draw_set visible, casters;
    triangle_cull cull; /* of what is visible */
    bool draws_hidden;  /* for tests: quick frames draw all, too */
    grow_list blended;  /* blended_draw */
    size_t blended_count;
    frame_block frame;
};

/** Makes room for `size` bytes; keeps what is there. @return false: no memory; the list is as it was */
bool nook_grow(grow_list *list, size_t size);

/* deform_pass.c */
/** @return as nook_render_scene_create */
nook_result nook_deform_create(nook_render_scene *scene);
void nook_deform_destroy(nook_render_scene *scene);

/* targets.c */
nook_result nook_targets_create(nook_gpu *gpu, uint32_t width, uint32_t height, render_targets *out);
void nook_targets_destroy(nook_gpu *gpu, render_targets *targets);

/* batch.c */
/** The box of what is drawn, mesh space. */
nook_box nook_draw_box(const nook_scene *scene, const nook_draw *draw);
/** Which draws of a frame go into a set. */
typedef struct batch_view {
    nook_matrix view_from_world; /* rigid */
    bool cull;                   /* leave out what lies outside the frustum */
    nook_matrix clip_from_view;  /* of the frustum; depth reversed. When it culls */
    double z_near;               /* when it culls */
    /** Order by where boxes end, not where they begin: what reaches from the eye to far away hides little and comes late. Among surfaces
        in one place the first is seen, so that exact frames keep to one order. */
    bool by_end;
} batch_view;
/** Culls, groups by mesh and uploads. @return NOOK_E_MEMORY */
nook_result nook_batch(nook_gpu *gpu, const nook_frame *frame, const batch_view *view, draw_set *set);
void nook_draw_set_destroy(nook_gpu *gpu, draw_set *set);

/* draw.c: state and calls that every geometry pass shares */
typedef struct raster_state {
    uint32_t depth_compare; /* GL_GREATER, ...; 0: no depth test */
    bool depth_write;
    bool cull; /* back faces of single-sided materials */
    bool blend;
    bool srgb;           /* encode into sRGB targets */
    nook_rectangle part; /* of the target; all zero: all of it */
} raster_state;
void nook_raster_begin(nook_gpu *gpu, nook_framebuffer framebuffer, raster_state state);
/** Back to GL's defaults, so that the caller's own drawing and compute passes find them. */
void nook_raster_end(nook_gpu *gpu);
uint32_t nook_vertex_array_create(nook_gpu *gpu);
/** Binds a scene's and a set's buffers for the draws that follow. */
void nook_bind_geometry(nook_renderer *renderer, const nook_render_scene *scene, const draw_set *set);
void nook_bind_material(nook_renderer *renderer, const nook_render_scene *scene, uint32_t material);
/** Draws instances of one primitive; its material is bound. */
void nook_draw_primitive(nook_renderer *renderer, const nook_render_scene *scene, uint32_t primitive,
                         uint32_t first_instance, uint32_t instance_count);
/** @param user  that of nook_draw_solid @return what a pass draws a material with, handle 0: not at all; masked: with holes */
typedef nook_program (*program_choice)(nook_renderer *renderer, const void *user, const render_material *material,
                                       bool masked);
/** Draws all primitives of a set but the blended ones, those with holes last. @param cull  back faces of single-sided ones */
void nook_draw_solid(nook_renderer *renderer, const nook_render_scene *scene, const draw_set *set,
                     program_choice choose, const void *user, bool cull);
/** The same of what is listed of a set. @param first_range  by draw */
void nook_draw_listed(nook_renderer *renderer, const nook_render_scene *scene, const draw_set *set,
                      program_choice choose, const void *user, bool cull, const index_list *list,
                      const uint32_t *first_range);
void nook_draw_fullscreen(nook_renderer *renderer, nook_program program);

/* chunks.c */
/** Nothing when they are made. @return NOOK_E_MEMORY */
nook_result nook_chunks_make(const nook_scene *scene, render_chunks *chunks);
void nook_chunks_destroy(render_chunks *chunks);

/* cull.c; in this order */
/** Whether this frame's triangles are culled; then renderer->cull.kept is to be drawn first. @return NOOK_E_MEMORY */
nook_result nook_cull_begin(nook_renderer *renderer, const nook_frame *frame);
/** Which triangles of what is visible have pixels, and which. */
void nook_cull_find(nook_renderer *renderer, const nook_frame *frame);
/**
 * Lists in renderer->cull.rest what shows besides, by the depth of what has been drawn, for which it waits; and in `kept` what the next
 * frame draws first.
 */
void nook_cull_list(nook_renderer *renderer, const nook_frame *frame);
void nook_cull_destroy(nook_gpu *gpu, triangle_cull *cull);

/* shadow_fit.c */
/** Fits the map to everything drawn. @return false: nothing is drawn */
bool nook_shadow_fit(const nook_frame *frame, shadow_fit *out);
/** Whether the map has room for a draw; true for one that shows nothing. */
bool nook_shadow_has_room(const shadow_fit *fit, const nook_scene *scene, const nook_draw *draw);
/** The texels that a draw's shadow can touch. @return false: none */
bool nook_shadow_rect(const shadow_fit *fit, const nook_scene *scene, const nook_draw *draw, shadow_rect *out);
bool nook_shadow_rects_meet(const shadow_rect *a, const shadow_rect *b);
/** Adds a part; parts that meet become one, and so do the two that waste least when there are too many. */
void nook_shadow_rects_add(shadow_rects *rects, shadow_rect added);

/* one per pass; frame.c calls them in order */
nook_result nook_pass_shadow(nook_renderer *renderer, const nook_frame *frame);
void nook_pass_gbuffer(nook_renderer *renderer, const nook_frame *frame);
/** Collects the blended primitives that are in view, farthest first. @return NOOK_E_MEMORY */
nook_result nook_collect_blended(nook_renderer *renderer, const nook_frame *frame);
/* part: all zero for the whole picture */
/** @param to_image  also tone maps: the picture, when nothing blended comes over it. false: the light, for nook_pass_view */
void nook_pass_lighting(nook_renderer *renderer, const nook_frame *frame, nook_texture visibility, bool to_image,
                        nook_rectangle part);
void nook_pass_blended(nook_renderer *renderer, const nook_frame *frame, nook_rectangle part);
void nook_pass_view(nook_renderer *renderer, nook_texture visibility, nook_view view, nook_rectangle part);

/* uniforms.c */
/** Fills and uploads the frame block; the shadow's part was filled by the shadow pass. */
void nook_uniforms_frame(nook_renderer *renderer, const nook_frame *frame);
void nook_uniforms_lights(nook_renderer *renderer, const nook_frame *frame);
/** Position of a camera in the world. */
void nook_camera_position(const nook_camera *camera, double out[3]);
bool nook_sun_shines(const nook_sun *sun);
