/* Triangles of what is visible that have pixels: those that are in the picture, hold the centre of a pixel and do not face away. Where
   rounding could decide a triangle has them. */
#include "engine/render/candidates.h"
#include <math.h>

/* What rounding may move a depth by, as a part of it. */
static const float depth_slack = 1e-4f;
/* What rounding may move a corner by, as a part of its distance from the picture's. */
static const float corner_rounding = 1e-6f;
/* What it may move a coordinate of clip space by, as a part of the sum of its four terms: the driver adds them in view space and again in
   clip space, 2^-24 for each product and sum, and so does this file. Little, but for a mesh whose own origin is far away. */
static const float term_rounding = 1e-6f;

/** How the instances of a primitive are looked at. */
typedef struct cull_view {
    float clip_from_mesh[16];
    float z_near, size[2];
    float slack; /* pixels that the driver may move a corner by */
    bool one_sided;
    float front; /* 1: fronts turn counter-clockwise, -1: clockwise */
} cull_view;

/** Where the vertices of a chunk are: pixels, and depth; depth is in (0, 1] for those that have a place in the picture. */
typedef struct chunk_places {
    float x[CHUNK_TRIANGLES * 3], y[CHUNK_TRIANGLES * 3], depth[CHUNK_TRIANGLES * 3];
    float aside, ahead; /* what rounding may move x and y (pixels) and w (metres) by, before they are divided by w */
} chunk_places;

/** What rounding may move a row of the product of the matrix and a point of the box by. */
static float round_row(const float *m, int row, const nook_box *box)
{
    float sum = fabsf(m[12 + row]);
    for (int k = 0; k < 3; k++)
        sum += fabsf(m[4 * k + row]) * fmaxf(fabsf(box->min[k]), fabsf(box->max[k]));
    return term_rounding * sum;
}

static void place_vertices(const cull_view *view, const render_chunks *chunks, const render_chunk *chunk,
                           chunk_places *restrict out)
{
    const float *m = view->clip_from_mesh;
    const float *restrict x = chunks->x + chunk->first_vertex, *restrict y = chunks->y + chunk->first_vertex,
                          *restrict z = chunks->z + chunk->first_vertex;
    const float half[2] = { 0.5f * view->size[0], 0.5f * view->size[1] }, z_near = view->z_near;
    const uint32_t count = chunk->vertex_count;
    for (uint32_t i = 0; i < count; i++) {
        float scale = 1.0f / (m[3] * x[i] + m[7] * y[i] + m[11] * z[i] + m[15]);
        out->x[i] = (m[0] * x[i] + m[4] * y[i] + m[8] * z[i] + m[12]) * scale * half[0] + half[0];
        out->y[i] = (m[1] * x[i] + m[5] * y[i] + m[9] * z[i] + m[13]) * scale * half[1] + half[1];
        out->depth[i] = z_near * scale;
    }
    out->aside = fmaxf(round_row(m, 0, &chunk->box) * half[0], round_row(m, 1, &chunk->box) * half[1]);
    out->ahead = round_row(m, 3, &chunk->box);
}

static float least(float a, float b, float c)
{
    float d = a < b ? a : b;
    return d < c ? d : c;
}

static float most(float a, float b, float c)
{
    float d = a > b ? a : b;
    return d > c ? d : c;
}

/** Not before the near plane, or so near to it that rounding decides. */
static bool is_ahead(const cull_view *view, const chunk_places *places, uint8_t corner)
{
    return view->z_near / places->depth[corner] > 0.999f * view->z_near - places->ahead;
}

/** The pixels whose centres lie between two places. @return false: none */
static bool find_pixels(float low, float high, float size, uint16_t *out_low, uint16_t *out_high)
{
    float first = low - 0.5f, last = high - 0.5f;
    if (!(last >= 0.0f && first < size))
        return false;
    *out_high = (uint16_t)(last < size - 1.0f ? last : size - 1.0f);
    *out_low = first > 0.0f ? (uint16_t)first : 0;
    *out_low = (uint16_t)(*out_low + ((float)*out_low < first));
    return *out_low <= *out_high;
}

/**
 * Pixels and facing of a triangle whose corners all have a place in the picture.
 * @param aside  pixels that rounding may move each corner by @param apart  the same, as a part of its distance from the picture's middle
 * @return false: none, or it faces away
 */
static bool place_corners(const cull_view *view, const float x[3], const float y[3], float aside, float apart,
                          pixel_rect *out)
{
    float low[2] = { least(x[0], x[1], x[2]), least(y[0], y[1], y[2]) };
    float high[2] = { most(x[0], x[1], x[2]), most(y[0], y[1], y[2]) };
    float area = ((x[1] - x[0]) * (y[2] - y[0]) - (x[2] - x[0]) * (y[1] - y[0])) * view->front;
    float farthest = most(most(high[0], high[1], -low[0]), -low[1], most(view->size[0], view->size[1], 0.0f));
    float slack = view->slack + aside + (corner_rounding + apart) * farthest;
    if (view->one_sided && area < -2.0f * slack * (high[0] - low[0] + high[1] - low[1]))
        return false;
    return find_pixels(low[0] - slack, high[0] + slack, view->size[0], &out->low[0], &out->high[0]) &&
           find_pixels(low[1] - slack, high[1] + slack, view->size[1], &out->low[1], &out->high[1]);
}

/** What pixels a triangle has, and how near it comes. @return false: it has none, or faces away */
static bool place_triangle(const cull_view *view, const chunk_places *places, const uint8_t corners[3],
                           cull_candidate *out)
{
    const float *x = places->x, *y = places->y, *depth = places->depth;
    const uint8_t a = corners[0], b = corners[1], c = corners[2];
    float nearest = most(depth[a], depth[b], depth[c]);
    float scale = nearest / view->z_near, apart = places->ahead * scale; /* 1 / w where that is least */
    if (least(depth[a], depth[b], depth[c]) > 0.0f && nearest <= 1.0f && apart < 0.1f) {
        out->depth = nearest * (1.0f + depth_slack + 2.0f * apart);
        return place_corners(view, (float[]){ x[a], x[b], x[c] }, (float[]){ y[a], y[b], y[c] }, places->aside * scale,
                             2.0f * apart, &out->rect);
    }
    out->depth = INFINITY; /* some corner is before the near plane, or may be anywhere */
    return is_ahead(view, places, a) || is_ahead(view, places, b) || is_ahead(view, places, c);
}

/** Whether all corners of a box lie beyond one plane of the frustum, by more than rounding. */
static bool is_outside(const cull_view *view, const nook_box *box)
{
    const float *m = view->clip_from_mesh, ahead = round_row(m, 3, box);
    const float aside = ahead + fmaxf(round_row(m, 0, box), round_row(m, 1, box));
    unsigned beyond = 31;
    for (int i = 0; i < 8; i++) {
        const float p[3] = { (i & 1 ? box->max : box->min)[0], (i & 2 ? box->max : box->min)[1],
                             (i & 4 ? box->max : box->min)[2] };
        float x = m[0] * p[0] + m[4] * p[1] + m[8] * p[2] + m[12], y = m[1] * p[0] + m[5] * p[1] + m[9] * p[2] + m[13],
              w = m[3] * p[0] + m[7] * p[1] + m[11] * p[2] + m[15], edge = w * 1.01f + aside;
        beyond &= (x > edge ? 1u : 0u) | (-x > edge ? 2u : 0u) | (y > edge ? 4u : 0u) | (-y > edge ? 8u : 0u) |
                  (w < view->z_near * 0.999f - ahead ? 16u : 0u);
    }
    return beyond != 0;
}

/** The triangles of one instance of one primitive. @param first_seen  of its first one @param posed  vertices are elsewhere */
static void add_primitive(triangle_cull *cull, const render_chunks *chunks, uint32_t primitive, uint32_t range,
                          uint32_t first_seen, const cull_view *view, bool posed)
{
    chunk_places places;
    cull_candidate *begin = (cull_candidate *)cull->candidates.items + cull->candidate_count, *next = begin;
    uint32_t first_triangle = chunks->items[chunks->first[primitive]].first_triangle;
    for (uint32_t i = chunks->first[primitive]; i < chunks->first[primitive + 1]; i++) {
        const render_chunk *chunk = &chunks->items[i];
        if (!posed && is_outside(view, &chunk->box))
            continue;
        if (!posed)
            place_vertices(view, chunks, chunk, &places);
        for (uint32_t k = chunk->first_triangle; k < chunk->first_triangle + chunk->triangle_count; k++) {
            next->chunk = i;
            next->triangle = k;
            next->range = range;
            next->seen = first_seen + k - first_triangle;
            next->depth = INFINITY;
            if (posed || place_triangle(view, &places, chunks->corners[k], next))
                next++;
        }
    }
    cull->candidate_count += (uint32_t)(next - begin);
}

/** The triangles of one instance. @param slack  as in cull_view */
static void add_draw(nook_renderer *renderer, const nook_frame *frame, const nook_matrix *clip_from_view, float slack,
                     const batch *b, uint32_t instance)
{
    triangle_cull *cull = &renderer->cull;
    const nook_render_scene *s = frame->scene;
    const nook_mesh *mesh = &s->scene->meshes[b->mesh];
    const instance_data *instances = renderer->visible.instances.items;
    const uint32_t draw = ((const uint32_t *)renderer->visible.draws.items)[instance];
    uint32_t seen = ((const uint32_t *)cull->first_seen.items)[draw];
    uint32_t range = ((const uint32_t *)cull->first_range.items)[draw];
    cull_view view = { .z_near = (float)frame->camera.z_near,
                       .size = { (float)renderer->width, (float)renderer->height },
                       .slack = slack,
                       .front = b->mirrored ? -1.0f : 1.0f };
    nook_matrix view_from_mesh = nook_matrix_from_float(instances[instance].view_from_mesh);
    nook_matrix clip_from_mesh = nook_matrix_multiply(clip_from_view, &view_from_mesh);
    nook_matrix_to_float(&clip_from_mesh, view.clip_from_mesh);
    for (uint32_t i = 0; i < mesh->primitive_count; i++, range++) {
        const nook_primitive *primitive = &s->scene->primitives[mesh->first_primitive + i];
        view.one_sided = frame->cull_back_faces && !s->scene->materials[primitive->material].double_sided;
        if (nook_primitive_is_opaque(s->scene, primitive))
            add_primitive(cull, &s->chunks, mesh->first_primitive + i, range, seen, &view,
                          frame->draws[draw].pose_version != 0);
        seen += primitive->index_count / 3;
    }
}

void nook_cull_find(nook_renderer *renderer, const nook_frame *frame)
{
    const batch *batches = renderer->visible.batches.items;
    nook_matrix clip_from_view = nook_renderer_clip_from_view(renderer, &frame->camera);
    GLint bits = 4; /* of a pixel's fraction, the fewest that GL allows */
    renderer->gpu->gl->GetIntegerv(GL_SUBPIXEL_BITS, &bits);
    const float slack = ldexpf(1.0f, 1 - bits);
    renderer->cull.candidate_count = 0;
    for (uint32_t i = 0; i < renderer->visible.batch_count; i++) {
        for (uint32_t k = 0; k < batches[i].instance_count; k++)
            add_draw(renderer, frame, &clip_from_view, slack, &batches[i], batches[i].first_instance + k);
    }
}
