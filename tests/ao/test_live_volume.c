/* Volumes that the GPU makes anew, against those that are baked. */
#include "engine/core/matrix.h"
#include "modules/ao/ao_internal.h"
#include "modules/bake/voxelize.h"
#include "tests/support/log_capture.h"
#include "tests/support/test_gpu.h"
#include "tests/support/test_mask.h"
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

enum { RESOLUTION = 48, GRID = RESOLUTION + 3, SEGMENTS = 20, RINGS = 10, TRIANGLES = 2 * SEGMENTS * (RINGS - 1) };

typedef struct soup {
    float positions[TRIANGLES * 3 + 6][3];
    uint32_t indices[TRIANGLES * 3 + 6];
} soup;

static void on_sphere(int ring, int segment, float turn, float out[3])
{
    float polar = 3.14159265f * (float)ring / RINGS,
          around = 6.2831853f * (float)(segment % SEGMENTS) / SEGMENTS + turn;
    out[0] = 0.9f * sinf(polar) * cosf(around);
    out[1] = 0.9f * cosf(polar);
    out[2] = 0.9f * sinf(polar) * sinf(around);
}

/* A closed ball in a cube of 2 m, whose corners two more triangles reach, so that both grids lie alike. */
static void make_soup(soup *out, uint32_t seed)
{
    static const float corners[6][3] = { { -1, -1, -1 }, { -1, -1, -0.5f }, { -1, -0.5f, -1 },
                                         { 1, 1, 1 },    { 1, 1, 0.5f },    { 1, 0.5f, 1 } };
    float(*p)[3] = out->positions, turn = 0.1f * (float)seed;
    for (int ring = 0; ring < RINGS; ring++)
        for (int segment = 0; segment < SEGMENTS; segment++) {
            if (ring > 0) {
                on_sphere(ring, segment, turn, *p++);
                on_sphere(ring, segment + 1, turn, *p++);
                on_sphere(ring + 1, segment, turn, *p++);
            }
            if (ring < RINGS - 1) {
                on_sphere(ring, segment + 1, turn, *p++);
                on_sphere(ring + 1, segment + 1, turn, *p++);
                on_sphere(ring + 1, segment, turn, *p++);
            }
        }
    memcpy(p, corners, sizeof corners);
    for (uint32_t i = 0; i < TRIANGLES * 3 + 6; i++)
        out->indices[i] = i;
}

typedef struct fixture {
    nook_ao *ao;
    nook_gpu *gpu;
    nook_ao_volume volume;
    nook_buffer vertices, indices;
    nook_ao_triangle_range range;
    nook_ao_live_part part;
    nook_ao_live_mesh mesh;
    uint8_t *voxels; /* GRID^3 of the last voxelise */
} fixture;

static fixture open_fixture(nook_gpu *gpu, const soup *s)
{
    fixture f = { .gpu = gpu };
    const nook_ao_desc desc = { .version = NOOK_AO_VERSION, .gpu = gpu, .width = 8, .height = 8 };
    const uint32_t size[3] = { GRID, GRID, GRID };
    assert_int_equal(nook_ao_create(&desc, &f.ao), NOOK_OK);
    assert_int_equal(nook_ao_add_live_volume(f.ao, "soup", size, &f.volume), NOOK_OK);
    assert_int_equal(nook_buffer_create(gpu, s->positions, sizeof s->positions, &f.vertices), NOOK_OK);
    assert_int_equal(nook_buffer_create(gpu, s->indices, sizeof s->indices, &f.indices), NOOK_OK);
    f.range = (nook_ao_triangle_range){ .index_count = TRIANGLES * 3 + 6 };
    f.part = (nook_ao_live_part){ .range_count = 1 };
    memcpy(f.part.volume_from_part, nook_matrix_identity().m, sizeof f.part.volume_from_part);
    f.mesh = (nook_ao_live_mesh){ .vertex_buffer = f.vertices.id,
                                  .vertex_stride = 3 * sizeof(float),
                                  .index_buffer = f.indices.id,
                                  .part_count = 1,
                                  .box_min = { -1, -1, -1 },
                                  .box_max = { 1, 1, 1 },
                                  .voxel_size = 2.0 / RESOLUTION };
    f.voxels = calloc(GRID * GRID * GRID, 1);
    assert_non_null(f.voxels);
    return f;
}

/* Of the mesh as it is told. */
static void read_voxels(fixture *f)
{
    assert_int_equal(nook_ao_voxelize(f->ao, f->volume, &f->mesh), NOOK_OK);
    const atlas_entry *entry = volume_atlas_find(&f->ao->atlases[NOOK_VOLUME_BINARY], f->volume.id);
    assert_int_equal(entry->info.width, GRID);
    nook_texture_read(f->gpu, f->ao->atlases[NOOK_VOLUME_BINARY].texture, GL_RED, GL_UNSIGNED_BYTE, f->voxels,
                      GRID * GRID * GRID);
}

static void voxelize(fixture *f)
{
    f->part.ranges = &f->range;
    f->mesh.parts = &f->part;
    read_voxels(f);
}

static void close_fixture(fixture *f)
{
    nook_buffer_destroy(f->gpu, &f->vertices);
    nook_buffer_destroy(f->gpu, &f->indices);
    nook_ao_destroy(f->ao);
    free(f->voxels);
}

static nook_volume bake(const soup *s)
{
    nook_volume volume;
    const nook_triangles triangles = { s->positions[0], 0, TRIANGLES * 3 + 6, s->indices, TRIANGLES * 3 + 6 };
    const nook_voxelize_desc desc = { .resolution = RESOLUTION, .threads = 1 };
    assert_int_equal(nook_voxelize(&triangles, &desc, &volume), NOOK_OK);
    assert_int_equal(volume.info.width, RESOLUTION + 2);
    return volume;
}

static int baked_at(const nook_volume *volume, int x, int y, int z)
{
    const int side = RESOLUTION + 2;
    if (x < 0 || y < 0 || z < 0 || x >= side || y >= side || z >= side)
        return 0;
    return volume->voxels[(z * side + y) * side + x] != 0;
}

static int baked_near(const nook_volume *volume, int x, int y, int z)
{
    int near = 0;
    for (int i = 0; i < 27; i++)
        near = near || baked_at(volume, x + i % 3 - 1, y + i / 3 % 3 - 1, z + i / 9 - 1);
    return near;
}

static int live_near(const fixture *f, int x, int y, int z)
{
    int near = 0;
    for (int i = 0; i < 27; i++) {
        int p[3] = { x + i % 3 - 1, y + i / 3 % 3 - 1, z + i / 9 - 1 };
        bool inside = p[0] >= 0 && p[1] >= 0 && p[2] >= 0 && p[0] < GRID && p[1] < GRID && p[2] < GRID;
        near = near || (inside && f->voxels[(p[2] * GRID + p[1]) * GRID + p[0]] != 0);
    }
    return near;
}

static void test_slicemaps_mark_what_the_bake_marks(void **state)
{
    nook_gpu *gpu = test_gpu_of(state);
    static soup s;
    for (uint32_t seed = 1; seed <= 3; seed++) {
        make_soup(&s, seed);
        fixture f = open_fixture(gpu, &s);
        nook_volume volume = bake(&s);
        int marked = 0, more = 0, fewer = 0;
        voxelize(&f);
        for (int z = 0; z < GRID; z++)
            for (int y = 0; y < GRID; y++)
                for (int x = 0; x < GRID; x++) {
                    int live = f.voxels[(z * GRID + y) * GRID + x] != 0, baked = baked_at(&volume, x, y, z);
                    marked += baked;
                    more += live && !baked;
                    fewer += baked && !live;
                    assert_true(!live || baked_near(&volume, x, y, z));
                    assert_true(!baked || live_near(&f, x, y, z));
                }
        if (more + fewer >
            marked / 20) /* corners are snapped to 1/256 of a pixel, which steep triangles turn into layers */
            fail_msg("of %d baked voxels %d are missing, %d are too many", marked, fewer, more);
        nook_volume_free(&volume);
        close_fixture(&f);
    }
}

/* A sheet across z in a cube of 2 m with a checker of 8 x 8 fields, 6 voxels each, and a speck in either corner. */
typedef struct checked_sheet {
    struct {
        float position[3], uv[2];
    } vertices[10];
    uint32_t indices[12];
    uint8_t texels[16];
} checked_sheet;

static void make_checked_sheet(checked_sheet *s)
{
    static const uint32_t indices[12] = { 0, 1, 2, 2, 1, 3, 4, 5, 6, 7, 8, 9 };
    static const float specks[6][3] = { { -1, -1, -1 }, { -0.99f, -1, -1 }, { -1, -0.99f, -1 },
                                        { 1, 1, 1 },    { 0.99f, 1, 1 },    { 1, 0.99f, 1 } };
    memset(s, 0, sizeof *s);
    for (int i = 0; i < 4; i++) {
        const float right = (float)(i & 1), high = (float)(i >> 1);
        s->vertices[i].position[0] = 2.0f * right - 1.0f;
        s->vertices[i].position[1] = 2.0f * high - 1.0f;
        s->vertices[i].position[2] = 0.02f + 0.001f * right;
        s->vertices[i].uv[0] = 2.0f + 4.0f * right, s->vertices[i].uv[1] = 4.0f * high - 3.0f;
    }
    for (int i = 0; i < 6; i++)
        memcpy(s->vertices[4 + i].position, specks[i], sizeof specks[i]);
    memcpy(s->indices, indices, sizeof indices);
    for (int i = 0; i < 4; i++) /* RGBA: a checker of 2 x 2 */
        s->texels[4 * i + 3] = i == 0 || i == 3 ? 200 : 100;
}

/* @param texture  0: none @return how many of the layer of the sheet are marked */
static int count_layer(fixture *f, uint32_t texture, float factor)
{
    const nook_ao_triangle_range ranges[2] = { { 0, 6, 0, 1 }, { 6, 6, 0, 0 } };
    const nook_ao_live_mask mask = { texture, factor, 0.5f };
    int count = 0;
    f->part.ranges = ranges;
    f->part.range_count = 2;
    f->mesh.parts = &f->part;
    f->mesh.masks = &mask;
    read_voxels(f);
    for (int y = 2; y < RESOLUTION; y++)
        for (int x = 2; x < RESOLUTION; x++)
            count += f->voxels[(25 * GRID + y) * GRID + x] != 0;
    f->part.ranges = NULL;
    f->mesh.masks = NULL;
    return count;
}

static void show_sheet(fixture *f, const checked_sheet *sheet)
{
    nook_buffer_destroy(f->gpu, &f->vertices);
    nook_buffer_destroy(f->gpu, &f->indices);
    assert_int_equal(nook_buffer_create(f->gpu, sheet->vertices, sizeof sheet->vertices, &f->vertices), NOOK_OK);
    assert_int_equal(nook_buffer_create(f->gpu, sheet->indices, sizeof sheet->indices, &f->indices), NOOK_OK);
    f->mesh.vertex_buffer = f->vertices.id, f->mesh.index_buffer = f->indices.id;
    f->mesh.vertex_stride = sizeof sheet->vertices[0];
    f->mesh.uv_offset = 3 * sizeof(float);
}

static void test_masks_have_the_holes_that_the_bake_has(void **state)
{
    nook_gpu *gpu = test_gpu_of(state);
    static soup s;
    checked_sheet sheet;
    nook_texture texture;
    nook_volume baked;
    make_checked_sheet(&sheet);
    make_soup(&s, 1);
    fixture f = open_fixture(gpu, &s);
    show_sheet(&f, &sheet);
    assert_int_equal(nook_texture_create_mipped(gpu, GL_SRGB8_ALPHA8, 2, 2, sheet.texels, &texture), NOOK_OK);
    const int all = count_layer(&f, 0, 1.0f), half = count_layer(&f, texture.id, 1.0f);
    static uint8_t voxels[GRID * GRID * GRID];
    memcpy(voxels, f.voxels, sizeof voxels);
    assert_int_equal(all, (RESOLUTION - 2) * (RESOLUTION - 2));
    assert_int_equal(count_layer(&f, texture.id, 0.6f), 0);   /* of 200, too */
    assert_int_equal(count_layer(&f, texture.id, 1.3f), all); /* of 100, too */
    float uvs[10][2];
    for (int i = 0; i < 10; i++)
        memcpy(uvs[i], sheet.vertices[i].uv, sizeof uvs[i]);
    nook_alpha_part part = test_mask(0, 6, sheet.texels, 2);
    part.texel_size = 4;
    const nook_alphas alphas = { &part, 1, uvs[0] };
    const nook_triangles triangles = { sheet.vertices[0].position, sizeof sheet.vertices[0], 10, sheet.indices, 12 };
    const nook_voxelize_desc desc = { .resolution = RESOLUTION, .threads = 1, .alphas = &alphas };
    assert_int_equal(nook_voxelize(&triangles, &desc, &baked), NOOK_OK);
    for (int y = 2; y < RESOLUTION; y++)
        for (int x = 2; x < RESOLUTION; x++)
            assert_int_equal(voxels[(25 * GRID + y) * GRID + x] != 0, baked_at(&baked, x, y, 25));
    assert_int_equal(half, all / 2);
    nook_volume_free(&baked);
    nook_texture_destroy(gpu, &texture);
    close_fixture(&f);
}

/** Filtering, in all units that voxelising uses; level 0 of a mask alone is no whole texture through it, nor are layers' bits. */
static void test_masks_have_their_holes_however_the_host_samples(void **state)
{
    nook_gpu *gpu = test_gpu_of(state);
    const nook_gl *gl = gpu->gl;
    static soup s;
    checked_sheet sheet;
    nook_texture texture;
    GLuint sampler;
    make_checked_sheet(&sheet);
    make_soup(&s, 1);
    fixture f = open_fixture(gpu, &s);
    show_sheet(&f, &sheet);
    assert_int_equal(nook_texture_create_2d(gpu, GL_RGBA8, 2, 2, GL_NEAREST, &texture), NOOK_OK);
    gl->TextureSubImage2D(texture.id, 0, 0, 0, 2, 2, GL_RGBA, GL_UNSIGNED_BYTE, sheet.texels);
    const int half = count_layer(&f, texture.id, 1.0f);
    assert_int_equal(half, (RESOLUTION - 2) * (RESOLUTION - 2) / 2);
    gl->CreateSamplers(1, &sampler);
    gl->SamplerParameteri(sampler, GL_TEXTURE_MIN_FILTER, GL_LINEAR_MIPMAP_LINEAR);
    for (GLuint unit = 0; unit < 8; unit++)
        gl->BindSampler(unit, sampler);
    assert_int_equal(count_layer(&f, texture.id, 1.0f), half);
    const GLuint used[] = { 0, 1, 2, NOOK_SLICING_UNIT };
    for (size_t i = 0; i < NOOK_COUNT(used); i++) {
        GLint bound = -1;
        gl->ActiveTexture(GL_TEXTURE0 + used[i]);
        gl->GetIntegerv(GL_SAMPLER_BINDING, &bound);
        assert_int_equal(bound, 0);
    }
    gl->ActiveTexture(GL_TEXTURE0);
    for (GLuint unit = 0; unit < 8; unit++)
        gl->BindSampler(unit, 0);
    gl->TextureParameteri(texture.id, GL_TEXTURE_MIN_FILTER, GL_LINEAR_MIPMAP_LINEAR);
    gl->TextureParameteri(texture.id, GL_TEXTURE_MAX_LEVEL, 1000);
    assert_int_equal(count_layer(&f, texture.id, 1.0f), half);
    gl->DeleteSamplers(1, &sampler);
    nook_texture_destroy(gpu, &texture);
    close_fixture(&f);
}

static void test_a_volume_made_anew_forgets_what_was_in_it(void **state)
{
    nook_gpu *gpu = test_gpu_of(state);
    static soup s;
    make_soup(&s, 7);
    fixture f = open_fixture(gpu, &s);
    voxelize(&f);
    f.range.first_index = TRIANGLES * 3;
    f.range.index_count = 6;
    voxelize(&f);
    int marked = 0;
    for (int i = 0; i < GRID * GRID * GRID; i++)
        marked += f.voxels[i] != 0;
    assert_true(marked > 50 && marked < 400); /* two triangles of 12 by 12 voxels */
    close_fixture(&f);
}

static void test_what_is_made_of_the_atlas_learns_of_a_volume_made_anew(void **state)
{
    nook_gpu *gpu = test_gpu_of(state);
    static soup s;
    make_soup(&s, 7);
    fixture f = open_fixture(gpu, &s);
    voxelize(&f);
    volume_atlas *atlas = &f.ao->atlases[NOOK_VOLUME_BINARY];
    assert_int_equal(volume_atlas_flush(atlas), NOOK_OK);
    uint32_t version = atlas->version;
    assert_int_equal(volume_atlas_flush(atlas), NOOK_OK);
    assert_int_equal(atlas->version, version); /* nothing has happened */
    voxelize(&f);
    assert_int_equal(volume_atlas_flush(atlas), NOOK_OK);
    assert_int_equal(atlas->version, version + 1);
    assert_int_equal(atlas->changes.count, 1);
    assert_memory_equal(&atlas->changes.boxes[0], &volume_atlas_find(atlas, f.volume.id)->box, sizeof(nook_ao_box));
    close_fixture(&f);
}

static void test_grids_move_by_whole_voxels(void **state)
{
    nook_gpu *gpu = test_gpu_of(state);
    static soup s;
    make_soup(&s, 7);
    fixture f = open_fixture(gpu, &s);
    f.part.ranges = &f.range;
    f.mesh.parts = &f.part;
    for (float by = -0.3f; by < 0.3f; by += 0.0371f) {
        f.mesh.box_min[0] = -0.5f + by;
        f.mesh.box_max[0] = 0.5f + by;
        assert_int_equal(nook_ao_voxelize(f.ao, f.volume, &f.mesh), NOOK_OK);
        const nook_volume_info *info = &volume_atlas_find(&f.ao->atlases[NOOK_VOLUME_BINARY], f.volume.id)->info;
        double whole = info->origin[0] / info->voxel_size;
        assert_true(fabs(whole - round(whole)) < 1e-9);
        assert_true(info->origin[0] + info->voxel_size <= (double)f.mesh.box_min[0] + 1e-9);
        assert_true(info->origin[0] + (info->width - 1.0) * info->voxel_size >= (double)f.mesh.box_max[0] - 1e-9);
    }
    close_fixture(&f);
}

static void test_parts_stand_where_their_matrices_put_them(void **state)
{
    nook_gpu *gpu = test_gpu_of(state);
    static soup s;
    static uint8_t before[GRID * GRID * GRID];
    make_soup(&s, 7);
    fixture f = open_fixture(gpu, &s);
    voxelize(&f);
    memcpy(before, f.voxels, sizeof before);
    close_fixture(&f);
    for (size_t i = 0; i < NOOK_COUNT(s.positions); i++) { /* half as large, axes exchanged: exact in floats */
        const float p[3] = { s.positions[i][0], s.positions[i][1], s.positions[i][2] };
        for (int k = 0; k < 3; k++)
            s.positions[i][k] = 0.5f * p[(k + 1) % 3];
    }
    f = open_fixture(gpu, &s);
    nook_ao_triangle_range halves[2] = { { 0, TRIANGLES * 3, 0, 0 }, { TRIANGLES * 3, 6, 0, 0 } };
    nook_ao_live_part parts[2] = { { &halves[0], 1, { 0 } }, { &halves[1], 1, { 0 } } };
    for (int i = 0; i < 2; i++) {
        for (int k = 0; k < 3; k++)
            parts[i].volume_from_part[k * 4 + (k + 1) % 3] = 2.0;
        parts[i].volume_from_part[15] = 1.0;
    }
    f.mesh.parts = parts;
    f.mesh.part_count = 2;
    read_voxels(&f);
    assert_memory_equal(f.voxels, before, sizeof before);
    parts[0].volume_from_part[12] = 3.0 * f.mesh.voxel_size; /* the ball alone */
    read_voxels(&f);
    for (int z = 8; z < GRID - 8; z++)
        for (int y = 8; y < GRID - 8; y++)
            for (int x = 8; x < GRID - 8; x++)
                assert_int_equal(f.voxels[(z * GRID + y) * GRID + x], before[(z * GRID + y) * GRID + x - 3]);
    close_fixture(&f);
}

/* Squares across each axis near the far end of a grid of more layers than one texel of a slicemap has. */
static void test_layers_beyond_the_first_texel_are_those_of_the_grid(void **state)
{
    enum { LARGE = 300, AT = 280 };
    nook_gpu *gpu = test_gpu_of(state);
    static soup s;
    const float low = 20.5f, high = 290.5f, across = AT + 0.5f; /* voxels of 1 m; the grid begins at -1 */
    const float corners[6][2] = { { low, low },  { high, low }, { low, high },
                                  { low, high }, { high, low }, { high, high } };
    for (int axis = 0; axis < 3; axis++) {
        for (int i = 0; i < 6; i++) {
            s.positions[i][axis] = across;
            s.positions[i][(axis + 1) % 3] = corners[i][0];
            s.positions[i][(axis + 2) % 3] = corners[i][1];
            s.indices[i] = (uint32_t)i;
        }
        fixture f = open_fixture(gpu, &s);
        const uint32_t size[3] = { LARGE, LARGE, LARGE };
        nook_ao_volume large;
        uint8_t *voxels = malloc((size_t)LARGE * LARGE * LARGE);
        assert_non_null(voxels);
        nook_ao_remove_volume(f.ao, f.volume);
        assert_int_equal(nook_ao_add_live_volume(f.ao, "large", size, &large), NOOK_OK);
        f.range.index_count = 6;
        f.part.ranges = &f.range;
        f.mesh.parts = &f.part;
        f.mesh.voxel_size = 1.0;
        for (int k = 0; k < 3; k++) {
            f.mesh.box_min[k] = 0.0f;
            f.mesh.box_max[k] = LARGE - 3;
        }
        assert_int_equal(nook_ao_voxelize(f.ao, large, &f.mesh), NOOK_OK);
        const nook_texture atlas = f.ao->atlases[NOOK_VOLUME_BINARY].texture;
        assert_int_equal(atlas.width, LARGE);
        nook_texture_read(gpu, atlas, GL_RED, GL_UNSIGNED_BYTE, voxels, (size_t)LARGE * LARGE * LARGE);
        for (int z = 0; z < LARGE; z++)
            for (int y = 0; y < LARGE; y++)
                for (int x = 0; x < LARGE; x++) {
                    const int at[3] = { x - 1, y - 1, z - 1 }; /* metres */
                    bool full = at[axis] == AT;
                    for (int k = 1; k < 3; k++)
                        full = full && at[(axis + k) % 3] >= 20 && at[(axis + k) % 3] <= 290;
                    int own = voxels[(z * LARGE + y) * LARGE + x] != 0;
                    bool edge = false; /* whose centres the edges run through */
                    for (int k = 1; k < 3; k++)
                        edge = edge || at[(axis + k) % 3] == 20 || at[(axis + k) % 3] == 290;
                    assert_true(own == full || (full && edge));
                }
        free(voxels);
        close_fixture(&f);
    }
}

static void test_sizes_and_ids_that_cannot_be_are_refused(void **state)
{
    nook_gpu *gpu = test_gpu_of(state);
    static soup s;
    nook_log_capture log;
    const uint32_t large[3] = { 64, NOOK_AO_LIVE_SIDE_MAX + 1, 64 }, flat[3] = { 64, 64, 2 };
    nook_ao_volume volume = { 77 };
    make_soup(&s, 7);
    fixture f = open_fixture(gpu, &s);
    nook_log_capture_begin(&log);
    assert_int_equal(nook_ao_add_live_volume(f.ao, "large", large, &volume), NOOK_E_RANGE);
    assert_int_equal(nook_ao_add_live_volume(f.ao, "flat", flat, &volume), NOOK_E_RANGE);
    assert_int_equal(nook_ao_voxelize(f.ao, volume, &f.mesh), NOOK_E_ARG);
    f.mesh.voxel_size = 0.0;
    assert_int_equal(nook_ao_voxelize(f.ao, f.volume, &f.mesh), NOOK_E_ARG);
    nook_log_capture_end();
    assert_int_equal(volume.id, 77);
    close_fixture(&f);
}

/* As they are before any vertex has widened them. */
static void test_boxes_inside_out_are_refused_and_change_nothing(void **state)
{
    static const float none[][2] = { { 1.0f, -1.0f }, { 3e38f, -3e38f }, { INFINITY, -INFINITY } };
    static soup s;
    nook_log_capture log;
    make_soup(&s, 7);
    fixture f = open_fixture(test_gpu_of(state), &s);
    voxelize(&f);
    const nook_volume_info before = volume_atlas_find(&f.ao->atlases[NOOK_VOLUME_BINARY], f.volume.id)->info;
    for (size_t i = 0; i < NOOK_COUNT(none); i++) {
        f.mesh.box_min[1] = none[i][0], f.mesh.box_max[1] = none[i][1];
        nook_log_capture_begin(&log);
        assert_int_equal(nook_ao_voxelize(f.ao, f.volume, &f.mesh), NOOK_E_ARG);
        nook_log_capture_end();
        assert_int_equal(log.count, 1);
        assert_non_null(strstr(log.text, "box"));
        assert_memory_equal(&volume_atlas_find(&f.ao->atlases[NOOK_VOLUME_BINARY], f.volume.id)->info, &before,
                            sizeof before);
    }
    close_fixture(&f);
}

static void test_a_volume_that_was_baked_is_not_voxelised_over(void **state)
{
    static soup s;
    nook_log_capture log;
    nook_volume baked;
    void *bytes;
    size_t size;
    nook_ao_volume volume;
    make_soup(&s, 7);
    fixture f = open_fixture(test_gpu_of(state), &s);
    const nook_triangles triangles = { s.positions[0], 0, NOOK_COUNT(s.positions), s.indices, NOOK_COUNT(s.indices) };
    assert_int_equal(nook_voxelize(&triangles, &(nook_voxelize_desc){ .resolution = 16 }, &baked), NOOK_OK);
    assert_int_equal(nook_volume_encode(&baked, &bytes, &size), NOOK_OK);
    assert_int_equal(nook_ao_add_volume(f.ao, "baked", bytes, size, &volume), NOOK_OK);
    nook_log_capture_begin(&log);
    f.part.ranges = &f.range;
    f.mesh.parts = &f.part;
    assert_int_equal(nook_ao_voxelize(f.ao, volume, &f.mesh), NOOK_E_ARG);
    nook_log_capture_end();
    assert_non_null(strstr(log.text, "live"));
    nook_volume_free(&baked);
    free(bytes);
    close_fixture(&f);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup_teardown(test_slicemaps_mark_what_the_bake_marks, test_gpu_setup, test_gpu_teardown),
        cmocka_unit_test_setup_teardown(test_masks_have_the_holes_that_the_bake_has, test_gpu_setup, test_gpu_teardown),
        cmocka_unit_test_setup_teardown(test_masks_have_their_holes_however_the_host_samples, test_gpu_setup,
                                        test_gpu_teardown),
        cmocka_unit_test_setup_teardown(test_a_volume_made_anew_forgets_what_was_in_it, test_gpu_setup,
                                        test_gpu_teardown),
        cmocka_unit_test_setup_teardown(test_what_is_made_of_the_atlas_learns_of_a_volume_made_anew, test_gpu_setup,
                                        test_gpu_teardown),
        cmocka_unit_test_setup_teardown(test_grids_move_by_whole_voxels, test_gpu_setup, test_gpu_teardown),
        cmocka_unit_test_setup_teardown(test_parts_stand_where_their_matrices_put_them, test_gpu_setup,
                                        test_gpu_teardown),
        cmocka_unit_test_setup_teardown(test_layers_beyond_the_first_texel_are_those_of_the_grid, test_gpu_setup,
                                        test_gpu_teardown),
        cmocka_unit_test_setup_teardown(test_sizes_and_ids_that_cannot_be_are_refused, test_gpu_setup,
                                        test_gpu_teardown),
        cmocka_unit_test_setup_teardown(test_boxes_inside_out_are_refused_and_change_nothing, test_gpu_setup,
                                        test_gpu_teardown),
        cmocka_unit_test_setup_teardown(test_a_volume_that_was_baked_is_not_voxelised_over, test_gpu_setup,
                                        test_gpu_teardown),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
