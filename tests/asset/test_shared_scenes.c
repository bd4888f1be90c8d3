/* The collection of real, hard and broken files, when it is there: NOOK_SHARED names the folder that holds scenes/. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include "engine/asset/scene.h"
#include "engine/core/file.h"
#include "tests/support/log_capture.h"
#include <dirent.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { PATH_CAPACITY = 4096, FIELDS = 12 };

static char folder[PATH_CAPACITY];

static void require_collection(void)
{
    char index[PATH_CAPACITY + 16];
    const char *shared = getenv("NOOK_SHARED");
    if (shared && *shared)
        nook_path_join(folder, sizeof folder, shared, "scenes");
    if (folder[0] && nook_file_exists(nook_path_join(index, sizeof index, folder, "index.tsv")))
        return;
    print_message("NOOK_SHARED is not set or names no folder with scenes/index.tsv: no shared scenes\n");
    skip();
}

/* Cuts a line at its tabs. @return fields found */
static int split(char *line, char *fields[FIELDS])
{
    int count = 0;
    for (char *at = line; at && count < FIELDS; count++) {
        char *tab = strchr(at, '\t');
        fields[count] = at;
        if (tab)
            *tab = '\0';
        at = tab ? tab + 1 : NULL;
    }
    return count;
}

/* Calls `check` for every line of a table. @return lines it took */
static int for_each_line(const char *name, bool (*check)(char *fields[FIELDS], int count))
{
    char path[PATH_CAPACITY];
    nook_file file;
    int taken = 0;
    assert_int_equal(nook_file_read(nook_path_join(path, sizeof path, folder, name), &file), NOOK_OK);
    for (char *line = (char *)file.bytes; line && *line;) {
        char *fields[FIELDS], *next = strchr(line, '\n');
        if (next)
            *next++ = '\0';
        taken += check(fields, split(line, fields));
        line = next;
    }
    nook_file_free(&file);
    return taken;
}

static uint32_t count_mesh_nodes(const nook_scene *scene)
{
    uint32_t count = 0;
    for (uint32_t i = 0; i < scene->node_count; i++)
        count += scene->nodes[i].mesh != NOOK_NONE;
    return count;
}

static uint32_t count_drawn_primitives(const nook_scene *scene)
{
    uint32_t count = 0;
    for (uint32_t i = 0; i < scene->node_count; i++)
        if (scene->nodes[i].mesh != NOOK_NONE)
            count += scene->meshes[scene->nodes[i].mesh].primitive_count;
    return count;
}

static void check_number(const char *file, const char *what, uint64_t got, const char *expected)
{
    if (got != strtoull(expected, NULL, 10))
        fail_msg("%s: %llu %s, expected %s", file, (unsigned long long)got, what, expected);
}

static void check_corner(const char *file, const double got[3], const char *expected, double tolerance)
{
    double corner[3];
    assert_int_equal(sscanf(expected, "%lf %lf %lf", &corner[0], &corner[1], &corner[2]), 3);
    for (int k = 0; k < 3; k++)
        if (!(fabs(got[k] - corner[k]) <= tolerance))
            fail_msg("%s: a corner of the box is %g %g %g, expected %s", file, got[0], got[1], got[2], expected);
}

static void check_plain_data(const char *file, const nook_scene *scene)
{
    for (size_t i = 0; i < scene->vertex_count; i++) {
        const float *n = scene->vertices[i].normal, *t = scene->vertices[i].tangent;
        double length = sqrt((double)n[0] * (double)n[0] + (double)n[1] * (double)n[1] + (double)n[2] * (double)n[2]);
        double tangent = sqrt((double)t[0] * (double)t[0] + (double)t[1] * (double)t[1] + (double)t[2] * (double)t[2]);
        if (!(fabs(length - 1.0) < 1e-5) || !(tangent == 0.0 || (tangent > 0.7 && tangent < 1.42)))
            fail_msg("%s: vertex %zu has a normal of length %g, a tangent of length %g", file, i, length, tangent);
    }
    for (uint32_t p = 0; p < scene->primitive_count; p++) {
        const nook_primitive *primitive = &scene->primitives[p];
        assert_true(primitive->material < scene->material_count);
        assert_true((size_t)primitive->first_vertex + primitive->vertex_count <= scene->vertex_count);
        assert_true((size_t)primitive->first_index + primitive->index_count <= scene->index_count);
        for (uint32_t i = 0; i < primitive->index_count; i++)
            assert_true(scene->indices[primitive->first_index + i] < primitive->vertex_count);
    }
}

/* file kind triangles nodes mesh_nodes primitives skins animations bbox_min bbox_max flags ... */
static bool check_scene(char *fields[FIELDS], int count)
{
    char path[PATH_CAPACITY];
    nook_scene *scene = NULL;
    nook_log_capture log;
    if (count < 11 || strcmp(fields[1], "gltf") != 0)
        return false;
    nook_log_capture_begin(&log);
    nook_result result = nook_scene_load(nook_path_join(path, sizeof path, folder, fields[0]), NULL, &scene);
    nook_log_capture_end();
    if (result != NOOK_OK || log.errors)
        fail_msg("%s: %d, %s", fields[0], result, log.text);
    check_number(fields[0], "triangles", scene->triangle_count, fields[2]);
    check_number(fields[0], "nodes", scene->file_node_count, fields[3]);
    check_number(fields[0], "nodes with a mesh", count_mesh_nodes(scene), fields[4]);
    check_number(fields[0], "skins", scene->skin_count, fields[6]);
    check_number(fields[0], "animations", scene->clip_count, fields[7]);
    /* The index counts points and lines among the primitives and in the box; we leave them out. */
    if (!strstr(fields[10], "points/lines")) {
        double size = 0.0;
        check_number(fields[0], "primitives", count_drawn_primitives(scene), fields[5]);
        for (int k = 0; k < 3; k++)
            size = fmax(size, scene->bounds_max[k] - scene->bounds_min[k]);
        check_corner(fields[0], scene->bounds_min, fields[8], 1e-4 * size);
        check_corner(fields[0], scene->bounds_max, fields[9], 1e-4 * size);
    }
    check_plain_data(fields[0], scene);
    nook_scene_destroy(scene);
    return true;
}

static void test_every_indexed_scene_loads_with_its_numbers(void **state)
{
    (void)state;
    require_collection();
    assert_true(for_each_line("index.tsv", check_scene) >= 70);
}

/* file, what is wrong, what a good loader does */
static bool check_malformed(char *fields[FIELDS], int count)
{
    char name[PATH_CAPACITY], path[PATH_CAPACITY];
    nook_scene *scene = NULL;
    nook_log_capture log;
    const char *extension = nook_path_extension(fields[0]);
    if (count < 3 || (strcmp(extension, ".glb") != 0 && strcmp(extension, ".gltf") != 0))
        return false;
    nook_path_join(name, sizeof name, "malformed", fields[0]);
    nook_log_capture_begin(&log);
    nook_result result = nook_scene_load(nook_path_join(path, sizeof path, folder, name), NULL, &scene);
    nook_log_capture_end();
    const char *verdict = fields[2];
    bool loaded = result == NOOK_OK,
         may_load = strstr(verdict, "load") || strstr(verdict, "accept") || strstr(verdict, "drop");
    bool may_reject = strncmp(verdict, "load", 4) != 0;
    if (loaded ? !may_load : !may_reject)
        fail_msg("%s: %s, but the verdict is '%s' (%s)", fields[0], loaded ? "loaded" : "refused", verdict, log.text);
    if (log.errors != (loaded ? 0 : 1) || loaded != (scene != NULL))
        fail_msg("%s: %d error lines, result %d", fields[0], log.errors, result);
    if (scene && strstr(verdict, "warning") && scene->warning_count == 0)
        fail_msg("%s: loaded without the warning it deserves", fields[0]);
    if (scene)
        check_plain_data(fields[0], scene);
    nook_scene_destroy(scene);
    return true;
}

static void test_every_malformed_file_meets_its_verdict(void **state)
{
    (void)state;
    require_collection();
    assert_true(for_each_line("malformed/manifest.tsv", check_malformed) >= 100);
}

/* @return files tried */
static int load_all_below(const char *path)
{
    int tried = 0;
    DIR *directory = opendir(path);
    assert_non_null(directory);
    for (struct dirent *entry; (entry = readdir(directory));) {
        char child[PATH_CAPACITY];
        nook_scene *scene = NULL;
        nook_log_capture log;
        nook_path_join(child, sizeof child, path, entry->d_name);
        if (entry->d_name[0] == '.')
            continue;
        if (nook_directory_exists(child)) {
            tried += load_all_below(child);
            continue;
        }
        nook_log_capture_begin(&log);
        nook_result result = nook_scene_load(child, NULL, &scene);
        nook_log_capture_end();
        assert_int_equal(log.errors, result == NOOK_OK ? 0 : 1);
        if (scene)
            check_plain_data(child, scene);
        nook_scene_destroy(scene);
        tried++;
    }
    closedir(directory);
    return tried;
}

static void test_broken_files_of_others_give_one_line_or_a_scene(void **state)
{
    (void)state;
    char path[PATH_CAPACITY];
    require_collection();
    assert_true(load_all_below(nook_path_join(path, sizeof path, folder, "malformed/third-party")) > 20);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_every_indexed_scene_loads_with_its_numbers),
        cmocka_unit_test(test_every_malformed_file_meets_its_verdict),
        cmocka_unit_test(test_broken_files_of_others_give_one_line_or_a_scene),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
