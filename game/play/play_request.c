#include "game/play/play_request.h"
#include "engine/core/file.h"
#include "game/command.h"
#include <stdio.h>
#include <strings.h>

static bool read_seed(void *target, const char *text)
{
    double number;
    nook_play_desc *desc = target;
    if (!nook_text_to_number(text, &number) || number < 0.0 || number > UINT32_MAX ||
        number != (double)(uint32_t)number)
        return false;
    desc->seed = (uint32_t)number;
    desc->seed_given = true;
    return true;
}

/* An option that would do nothing. @return its name, or NULL */
static const char *find_idle(const nook_play_request *r)
{
    if (!r->headless || r->capture)
        return NULL;
    return r->settings ? "settings" : r->from > 0.0 ? "from" : r->frames > 0 ? "frames" : NULL;
}

/* Endings of films and pictures that --capture does not make: a folder of such a name is nobody's wish. */
static bool is_other_film(const char *path)
{
    static const char *const endings[] = { ".mov", ".avi",  ".m4v",  ".mpg", ".mpeg", ".ogv",
                                           ".wmv", ".apng", ".webp", ".png", ".jpg",  ".jpeg" };
    for (size_t i = 0; i < NOOK_COUNT(endings); i++) {
        if (strcasecmp(nook_path_extension(path), endings[i]) == 0)
            return true;
    }
    return false;
}

static const char details[] =
    "LEVEL is a .level file or any glTF file, whose nodes become bodies; default: the engine house.\n"
    "Without a window the last line says how it ended: won, lost, ended (nothing to win) or undecided, after how many\n"
    "ticks of 1/60 s, and the hash of the state. It plays to the end of the replay or the pilot, or 2 s beyond that "
    "of\n"
    "the game, whichever is first; with neither, to the level's time limit.\n"
    "Levels: docs/playing.md. Pilots: game/play/pilot.h. volumes.budget = MIB, below technique = NAME in the "
    "settings,\n"
    "bounds the memory that volumes take: docs/streaming.md.\n";

bool nook_play_request_read(const char *root, int argc, char **argv, nook_play_request *out, int *out_exit_code)
{
    const nook_app app = { .root = root };
    *out = (nook_play_request){
        .desc = { .root = root }, .size = { 1280, 720 }, .backend = NOOK_BACKEND_AUTO, .pictures = "out"
    };
    out->cache = nook_option_default_cache(&app, out->default_cache);
    const nook_option options[] = {
        nook_option_row_flag("headless", &out->headless,
                             "without a window, as fast as it goes; nothing is drawn, but for --capture"),
        { .name = "seed",
          .kind = NOOK_OPTION_CUSTOM,
          .target = &out->desc,
          .placeholder = "N",
          .read = read_seed,
          .expects = "a whole number below 2^32",
          .help = "of the physics; default: the replay's, else 1" },
        nook_option_row_text("record", &out->desc.record, "FILE", "write what is pressed, tick by tick"),
        nook_option_row_text("replay", &out->desc.replay, "FILE", "play what was recorded; then the player goes on"),
        nook_option_row_text("pilot", &out->desc.pilot, "FILE", "play by a script of steps"),
        nook_option_row_settings(&out->settings,
                                 "technique and parameters, as ./nook tune writes them; default: the level's"),
        nook_option_row_size(&out->size, "of the window in pixels; default 1280x720"),
        nook_option_row_text("out", &out->pictures, "DIR", "where the pictures go that F12 takes; default out"),
        nook_option_row_from(&out->from, "let so much of the replay or pilot pass before the first picture"),
        nook_option_row_int("frames", &out->frames, 1, INT32_MAX, "end after so many pictures"),
        { .name = "capture",
          .kind = NOOK_OPTION_TEXT,
          .target = &out->capture,
          .placeholder = "DIR|FILE",
          .help = "every frame as a PNG into a folder, or a video by ffmpeg (.mp4, .mkv, .webm, .gif); frames then\n"
                  "                             last 1/30 s each, however long they take" },
        nook_option_row_backend(&out->backend),
        nook_option_row_cache(&out->cache, "baked volumes and the player's preferences; default: cache/ of Nook"),
    };
    const nook_usage usage = { .command = "play",
                               .summary = "Plays a level: first person, rigid bodies, weight and shadow.",
                               .positionals = "[LEVEL]",
                               .positional_max = 1,
                               .options = options,
                               .option_count = NOOK_COUNT(options),
                               .details = details };
    nook_arguments arguments;
    if (!nook_arguments_read(&usage, argc, argv, &arguments, out_exit_code))
        return false;
    const char *idle = find_idle(out);
    if (idle) {
        fprintf(stderr, "nook play: --%s: with --headless nothing is drawn; give --capture too, or leave it out\n",
                idle);
        *out_exit_code = NOOK_EXIT_USAGE;
        return false;
    }
    if (out->capture && is_other_film(out->capture)) {
        fprintf(stderr, "nook play: --capture %s: give a folder, or a video ending in .mp4, .mkv, .webm or .gif\n",
                out->capture);
        *out_exit_code = NOOK_EXIT_USAGE;
        return false;
    }
    out->desc.level = arguments.positionals[0];
    out->desc.skip_images = out->headless && !out->capture;
    return true;
}
