#include "engine/core/file.h"
#include "engine/core/log.h"
#include "game/level/level_scene.h"
#include "game/play/play.h"
#include <assert.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static const char default_level[] = "content/engine_house/engine_house.level";
enum { DEFAULT_SEED = 1, PATH_SIZE = 1024 };

/* ---- Opening ----------------------------------------------------------------------------------------------------- */

/* A path as it is kept in recordings: within the root where it lies there. */
static void name_level(const char *root, const char *path, char out[PATH_SIZE])
{
    size_t length = strlen(root);
    bool inside = strncmp(path, root, length) == 0 && path[length] == '/';
    snprintf(out, PATH_SIZE, "%s", inside ? path + length + 1 : path);
}

/* Where that path can be read from: here, or in the root. */
static void find_level(const char *root, const char *name, char out[PATH_SIZE])
{
    if (*name == '/' || nook_file_exists(name))
        snprintf(out, PATH_SIZE, "%s", name);
    else
        nook_path_join(out, PATH_SIZE, root, name);
    if (!nook_file_exists(out)) /* say the path that was given */
        snprintf(out, PATH_SIZE, "%s", name);
}

/* Where a level that a recording names can be read from: as any, or beside the recording. */
static void find_recorded_level(const nook_play_desc *desc, const char *name, char out[PATH_SIZE])
{
    find_level(desc->root, name, out);
    if (*name == '/' || nook_file_exists(out))
        return;
    int folder = (int)(nook_path_name(desc->replay) - desc->replay);
    char beside[PATH_SIZE];
    int length = snprintf(beside, sizeof beside, "%.*s%s", folder, desc->replay, name);
    if (length > 0 && length < (int)sizeof beside && nook_file_exists(beside))
        snprintf(out, PATH_SIZE, "%s", beside);
}

/* Whether two paths lead to one file. */
static bool same_file(const char *a, const char *b)
{
    char *real_a = realpath(a, NULL), *real_b = realpath(b, NULL);
    bool same = real_a && real_b && strcmp(real_a, real_b) == 0;
    free(real_a);
    free(real_b);
    return same;
}

static nook_result choose_level(const nook_play_desc *desc, nook_play *play, char out_path[PATH_SIZE])
{
    char *name = play->recording.level;
    if (desc->level)
        name_level(desc->root, desc->level, name);
    else
        snprintf(name, PATH_SIZE, "%s", desc->replay ? play->replay.level : default_level);
    find_level(desc->root, name, out_path);
    if (!desc->replay)
        return NOOK_OK;
    char recorded[PATH_SIZE];
    find_recorded_level(desc, play->replay.level, recorded);
    if (desc->level && strcmp(name, play->replay.level) != 0 && !same_file(out_path, recorded))
        return nook_fail(NOOK_E_ARG, "%s: was recorded in %s, not in %s; play that, or leave the level out",
                         desc->replay, play->replay.level, name);
    if (!desc->level)
        snprintf(out_path, PATH_SIZE, "%s", recorded);
    return NOOK_OK;
}

static nook_result read_files(const nook_play_desc *desc, nook_play *play)
{
    char path[PATH_SIZE];
    const nook_scene_options options = { .skip_images = desc->skip_images };
    nook_result result = desc->replay ? nook_recording_read(desc->replay, &play->replay) : NOOK_OK;
    if (result == NOOK_OK && desc->pilot) {
        result = nook_pilot_read(desc->pilot, &play->pilot);
        play->pilot_status = NOOK_PILOT_STEERS;
    }
    if (result == NOOK_OK)
        result = choose_level(desc, play, path);
    if (result == NOOK_OK)
        result = nook_level_read(path, &play->level);
    if (result == NOOK_OK)
        result = nook_level_scene_load(play->level, &options, &play->scene);
    return result;
}

static void clear(nook_play *play)
{
    nook_session_destroy(play->session);
    nook_game_world_destroy(play->own_world);
    nook_scene_destroy(play->scene);
    nook_level_free(play->level);
    nook_pilot_destroy(play->pilot);
    nook_recording_free(&play->recording);
    nook_recording_free(&play->replay);
    *play = (nook_play){ .seed = 0 };
}

nook_result nook_play_open(const nook_play_desc *desc, nook_play *out_play)
{
    nook_play play = { .pilot_status = NOOK_PILOT_DONE };
    *out_play = (nook_play){ .seed = 0 };
    nook_result result = desc->record ? nook_file_probe(desc->record) : NOOK_OK; /* not after minutes of play */
    if (result == NOOK_OK)
        result = read_files(desc, &play);
    if (result != NOOK_OK) {
        clear(&play);
        return result;
    }
    play.seed = desc->seed_given ? desc->seed : desc->replay ? play.replay.seed : DEFAULT_SEED;
    play.recording.seed = play.seed;
    snprintf(play.record_path, sizeof play.record_path, "%s", desc->record ? desc->record : "");
    *out_play = play;
    return NOOK_OK;
}

nook_scene *nook_play_take_scene(nook_play *play)
{
    nook_scene *scene = play->scene;
    assert(scene && !play->session);
    play->scene = NULL;
    return scene;
}

nook_result nook_play_begin(nook_play *play, const nook_scene *scene, nook_game_world *world)
{
    assert(!scene == !world && !play->session);
    nook_result result = NOOK_OK;
    if (!world)
        result = nook_game_world_create(play->scene, &play->own_world);
    const nook_session_desc desc = { .level = play->level,
                                     .scene = scene ? scene : play->scene,
                                     .world = world ? world : play->own_world,
                                     .seed = play->seed };
    if (result == NOOK_OK)
        result = nook_session_create(&desc, &play->session);
    if (result != NOOK_OK)
        return result;
    play->recording.origin = nook_session_origin(play->session);
    if (play->replay.origin != 0 && play->replay.origin != play->recording.origin)
        nook_log_warning("%s: is not as it was when the replay was recorded; it may end otherwise", play->level->path);
    return NOOK_OK;
}

nook_result nook_play_read_again(const nook_play *play, bool skip_images, nook_level **out_level,
                                 nook_scene **out_scene)
{
    const nook_scene_options options = { .skip_images = skip_images };
    *out_scene = NULL;
    nook_result result = nook_level_read(play->level->path, out_level);
    if (result == NOOK_OK)
        result = nook_level_scene_load(*out_level, &options, out_scene);
    if (result != NOOK_OK) {
        nook_level_free(*out_level);
        *out_level = NULL;
    }
    return result;
}

nook_result nook_play_go_on(nook_play *play, nook_level *level, const nook_scene *scene, nook_game_world *world)
{
    const nook_session_desc desc = { .level = level, .scene = scene, .world = world, .seed = play->seed };
    nook_session *session;
    nook_result result = nook_session_create(&desc, &session);
    if (result == NOOK_OK)
        result = nook_session_carry_over(session, play->session);
    if (result != NOOK_OK) {
        nook_session_destroy(session);
        nook_level_free(level);
        return result;
    }
    nook_session_destroy(play->session);
    nook_level_free(play->level);
    play->session = session;
    play->level = level;
    if (*play->record_path && !play->recording_ended)
        nook_log_warning("%s: the level has changed; %s ends here", level->path, play->record_path);
    play->recording_ended = true;
    return NOOK_OK;
}

/* ---- Playing ----------------------------------------------------------------------------------------------------- */

bool nook_play_is_free(const nook_play *play)
{
    return play->replayed >= play->replay.tick_count && play->pilot_status != NOOK_PILOT_STEERS;
}

static nook_play_input choose_input(nook_play *play, const nook_play_input *from_player)
{
    nook_play_input input = *from_player;
    if (play->replayed < play->replay.tick_count)
        return play->replay.inputs[play->replayed++];
    if (play->pilot_status == NOOK_PILOT_STEERS) {
        nook_play_input steered;
        play->pilot_status = nook_pilot_steer(play->pilot, play->session, &steered);
        if (play->pilot_status == NOOK_PILOT_STEERS)
            input = steered;
    }
    return input;
}

nook_result nook_play_tick(nook_play *play, const nook_play_input *from_player)
{
    const nook_play_input input = choose_input(play, from_player);
    bool records = *play->record_path && !play->recording_ended;
    nook_result result = records ? nook_recording_append(&play->recording, &input) : NOOK_OK;
    if (result == NOOK_OK)
        result = nook_session_tick(play->session, &input);
    if (result != NOOK_OK)
        return result;
    nook_session_view view = nook_session_look(play->session);
    if (view.status == NOOK_SESSION_PLAYING) {
        play->ended_at = 0;
    } else if (play->ended_at == 0) {
        play->ended_at = view.ticks;
        play->ended_hash = nook_session_hash(play->session);
    }
    return NOOK_OK;
}

nook_result nook_play_close(nook_play *play)
{
    nook_result result = NOOK_OK;
    if (*play->record_path && play->session)
        result = nook_recording_write(play->record_path, &play->recording);
    clear(play);
    return result;
}
