/** stream_internal.h - the inside of nook_stream, shared by the files of modules/stream only. */
#pragma once
#include "modules/ao/residency.h"
#include "modules/stream/loader.h"
#include "modules/stream/stream.h"

enum { LEVEL_NONE = -1 /* nothing of it */ };

typedef struct stream_level {
    char *path; /**< Owned. */
    nook_volume_info info;
    uint64_t bytes; /**< On the GPU. */
    double error;
    bool refused;    /**< Its file cannot be used: it is not asked for. */
    uint32_t pause;  /**< Updates until it is asked for again; 0 and refused: never. */
    uint32_t failed; /**< Times in a row that it was refused for something that may pass. */
} stream_level;

/** A body in one kind. */
typedef struct stream_item {
    nook_ao_volume volume;
    stream_level levels[NOOK_STREAM_LEVELS_MAX]; /**< The finest first. */
    int level_count;
    int resident;      /**< The level that is there. */
    int coming;        /**< The level that has a place, and is read or uploaded. */
    int job;           /**< Of the loader, for what comes. LOADER_NONE: not asked for yet. */
    int target;        /**< The level that is wanted. */
    bool passed_over;  /**< In this frame: there was no place for it. */
    double importance; /**< [0, 1]: of its body, from the views. */
    double score;      /**< Of its next step, while targets are chosen. */
    int step;          /**< That step: a level. */
} stream_item;

/** A volume of the AO. */
typedef struct stream_volume {
    nook_ao_volume volume;
    uint32_t users;
    stream_item *items[NOOK_VOLUME_KINDS]; /**< NULL: not there in this kind. Owned. */
    double importance;
    double centre[3], half[3]; /**< Of its box, mesh space. */
} stream_volume;

struct nook_stream {
    nook_ao *ao;
    nook_stream_params params;
    stream_loader *loader;
    stream_volume *volumes; /**< In the order of their ids, which is that of adding. */
    uint32_t count, capacity;
    stream_item **heap; /**< Scratch of heap_capacity: as many as there are items. */
    uint32_t heap_capacity, item_count;
    bool stale;                           /**< Rooms are to be fitted. */
    bool tight;                           /**< Not everything fits: there are rooms. */
    bool failed;                          /**< The rooms could not be made; until something changes nothing comes. */
    uint64_t rooms[NOOK_VOLUME_KINDS];    /**< Bytes; tight. */
    uint32_t sides[NOOK_VOLUME_KINDS][3]; /**< The same, of voxels: as they were made. */
    uint64_t kept
        [NOOK_VOLUME_KINDS]; /**< Bytes of each room that is taken by what others have added to stay, as of the last update. */
    uint64_t fitted;         /**< Bytes of memory after rooms were fitted. */
    float told_budget;                /**< That was warned of as too small; 0: none. */
    stream_item *of_job[LOADER_JOBS]; /**< What a job of the loader is for; NULL: nothing. */
    int writing;                      /**< The job whose contents are written in part; LOADER_NONE: none. */
    bool settled;                     /**< As of the last update. */
    uint32_t pauses;                  /**< Levels that have one. */
    uint64_t loads, evictions, frame_upload, largest_upload;
};

/** Calls for each item. */
#define STREAM_EACH(stream, item)                                                \
    for (uint32_t each_volume = 0; each_volume < (stream)->count; each_volume++) \
        for (int each_kind = 0; each_kind < NOOK_VOLUME_KINDS; each_kind++)      \
            for (stream_item *item = (stream)->volumes[each_volume].items[each_kind]; item; item = NULL)

stream_volume *stream_find(const nook_stream *stream, nook_ao_volume volume); /**< NULL: not there. */
double stream_error(const stream_item *item, int level);                      /**< 1 for LEVEL_NONE. */
uint64_t stream_bytes(const stream_item *item, int level);                    /**< 0 for LEVEL_NONE. */
uint64_t stream_budget_bytes(const nook_stream *stream);                      /**< UINT64_MAX: none. */
/** What comes is given up, and its place given back. */
void stream_cancel(nook_stream *stream, stream_item *item);
/** What is there goes. */
void stream_drop(nook_stream *stream, stream_item *item);
/** The finest level that can be used. @return LEVEL_NONE when there is none */
int stream_finest(const stream_item *item);
/** The next that can be used, finer than `level`; from LEVEL_NONE, the coarsest. @return LEVEL_NONE when there is none */
int stream_finer(const stream_item *item, int level);

/** Makes the rooms as budget and bodies ask, and says in stream->tight whether there are any. */
nook_result stream_fit(nook_stream *stream);
/** Bytes of memory that all kinds have. */
uint64_t stream_memory(const nook_stream *stream);
/** Whether a level is no larger than what its kind's room has for what comes and goes; where everything fits, yes. */
bool stream_room_holds(const nook_stream *stream, const stream_item *item, int level);
/** Gives a body that was just added its place, where everything has one. */
void stream_settle_in(nook_stream *stream, stream_item *item);
/** Weighs bodies by what is seen. */
void stream_weigh(nook_stream *stream, const nook_stream_view *views, uint32_t view_count,
                  const nook_ao_occluder *occluders, uint32_t occluder_count);
/** Chooses targets. */
void stream_choose(nook_stream *stream);
