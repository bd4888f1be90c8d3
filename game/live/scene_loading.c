#include "game/live/scene_loading.h"
#include "engine/core/jobs.h"
#include "engine/core/log.h"
#include "game/level/level_scene.h"
#include <pthread.h>
#include <stdatomic.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { PATH_CAPACITY = 4096, WHY_CAPACITY = 1024 };

/* Written by the thread until `done`. */
struct nook_scene_loading {
    nook_scene_loading_desc desc; /* its texts are those below */
    char path[PATH_CAPACITY], cache[PATH_CAPACITY];
    pthread_t thread;
    atomic_bool done;
    nook_loaded_scene loaded;
    nook_result result;
    char why[WHY_CAPACITY];
};

uint32_t nook_scene_unreadable_images(const nook_scene *scene)
{
    uint32_t count = 0;
    for (uint32_t i = 0; i < scene->image_count; i++)
        count += scene->images[i].pixels == NULL;
    return count;
}

/* A scene is drawn without an image that cannot be read; one that is shown with it goes on so. */
static nook_result check_images(const nook_scene_loading *load)
{
    const nook_scene *scene = load->loaded.scene;
    if (nook_scene_unreadable_images(scene) <= load->desc.unreadable_most)
        return NOOK_OK;
    const char *last = scene->warning_count > 0 ? scene->warnings[scene->warning_count - 1] : scene->path;
    return nook_fail(NOOK_E_FORMAT, "%s: the picture stays as it was", last);
}

static nook_result read_file(nook_scene_loading *load)
{
    nook_result result = nook_scene_load(load->path, NULL, &load->loaded.scene);
    return result == NOOK_OK ? nook_moment_stand_still(load->loaded.scene, &load->desc.moment) : result;
}

static nook_result read_scene(nook_scene_loading *load)
{
    nook_loaded_scene *loaded = &load->loaded;
    if (!load->desc.is_level)
        return read_file(load);
    nook_result result = nook_level_read(load->path, &loaded->level);
    return result == NOOK_OK ? nook_level_scene_load(loaded->level, NULL, &loaded->scene) : result;
}

/* A plan may make other volumes of the same scene. @return NULL: nothing is to be had of the scene that is shown */
static const nook_scene_volumes *collect_shown(const nook_scene_loading *load, const nook_volumes_desc *desc,
                                               nook_scene_volumes *out)
{
    if (!load->desc.shown || !load->desc.cache || !(load->desc.kinds & NOOK_VOLUME_BIT(NOOK_VOLUME_SURFEL)) ||
        load->desc.plan.params.mode != NOOK_PLAN_OFF)
        return NULL;
    return nook_volumes_collect(load->desc.shown, desc, out) == NOOK_OK ? out : NULL;
}

static void *run(void *user)
{
    nook_scene_loading *load = user;
    unsigned cores = nook_core_count();
    nook_scene_volumes shown = { 0 };
    nook_volumes_desc volumes = { .resolution = load->desc.resolution,
                                  .kinds = load->desc.kinds,
                                  .r_max = load->desc.r_max,
                                  .cache_dir = load->desc.cache,
                                  .plan = load->desc.plan,
                                  .streams = load->desc.streams,
                                  .threads = cores > 1 ? cores - 1 : 1 }; /* one is left for the picture */
    nook_log_keep_errors(load->why, sizeof load->why);
    load->result = read_scene(load);
    if (load->result == NOOK_OK)
        load->result = check_images(load);
    if (load->result == NOOK_OK && load->desc.live) {
        load->result = nook_volumes_collect(load->loaded.scene, &volumes, &load->loaded.volumes);
        if (load->result == NOOK_OK)
            load->result = nook_volumes_add_densities(load->loaded.scene, load->desc.resolution, &load->loaded.volumes);
    } else if (load->result == NOOK_OK) {
        volumes.before = collect_shown(load, &volumes, &shown);
        load->result = nook_volumes_bake(load->loaded.scene, &volumes, &load->loaded.volumes);
        nook_volumes_free(&shown);
    }
    atomic_store(&load->done, true);
    return NULL;
}

nook_result nook_scene_loading_start(const nook_scene_loading_desc *desc, nook_scene_loading **out_load)
{
    *out_load = NULL;
    nook_scene_loading *load = calloc(1, sizeof *load);
    if (!load)
        return nook_fail(NOOK_E_MEMORY, "%s: no memory to load it", desc->path);
    snprintf(load->path, sizeof load->path, "%s", desc->path);
    snprintf(load->cache, sizeof load->cache, "%s", desc->cache ? desc->cache : "");
    load->desc = *desc;
    load->desc.path = load->path;
    load->desc.cache = desc->cache ? load->cache : NULL;
    atomic_init(&load->done, false);
    if (pthread_create(&load->thread, NULL, run, load) != 0) {
        free(load);
        return nook_fail(NOOK_E_MEMORY, "%s: no thread to load it", desc->path);
    }
    *out_load = load;
    return NOOK_OK;
}

bool nook_scene_loading_is_done(const nook_scene_loading *load)
{
    return atomic_load(&load->done);
}

nook_result nook_scene_loading_finish(nook_scene_loading *load, nook_loaded_scene *out, char *out_why, size_t capacity)
{
    pthread_join(load->thread, NULL);
    nook_result result = load->result;
    if (result != NOOK_OK) {
        snprintf(out_why, capacity, "%s", load->why);
        nook_loaded_scene_free(&load->loaded);
    }
    *out = load->loaded;
    free(load);
    return result;
}

void nook_loaded_scene_free(nook_loaded_scene *loaded)
{
    nook_volumes_free(&loaded->volumes);
    nook_scene_destroy(loaded->scene);
    nook_level_free(loaded->level);
    *loaded = (nook_loaded_scene){ 0 };
}
