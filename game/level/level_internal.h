/** level_internal.h - inside game/level only: what the stages of reading a level share. */
#pragma once
#include "game/level/body.h"
#include "game/level/level.h"
#include "game/settings/line_reader.h"
#include <stddef.h>

/** A text being read. */
typedef struct nook_level_reading {
    nook_line_reader lines;
    nook_level *level; /**< Being filled. */
    nook_body_defaults body;
    uint32_t entity_capacity;
    uint32_t header_seen; /**< Bits of the lines at the top that were there. */
    uint32_t entity_seen; /**< Bits of the lines of the last entity that were there. */
} nook_level_reading;

/** One or more numbers, parted by blanks. @return NOOK_E_FORMAT, logged: as many are wanted, each in [lowest, highest] */
nook_result nook_level_read_numbers(const nook_level_reading *r, const char *name, const char *value, double *out,
                                    uint32_t count, double lowest, double highest);
/** A text that fits. @return NOOK_E_FORMAT, logged */
nook_result nook_level_read_text(const nook_level_reading *r, const char *name, const char *value, char *out,
                                 size_t capacity);

/** A line "[kind name]" without blanks around it. @return NOOK_E_FORMAT, NOOK_E_MEMORY */
nook_result nook_level_begin_entity(nook_level_reading *r, char *line);
/** A line "name = value" of the last entity. @return NOOK_E_FORMAT */
nook_result nook_level_read_entity_line(nook_level_reading *r, const char *name, const char *value);
/** What must stand in the last entity, if there is one. @return NOOK_E_FORMAT */
nook_result nook_level_end_entity(nook_level_reading *r);
/** What can be checked when all are there. @return NOOK_E_FORMAT */
nook_result nook_level_check_needs(const nook_level *level);

/** @return as nook_level_read */
nook_result nook_level_read_file(const char *path, nook_level *level);
/** A level of a glTF file. @return as nook_scene_load */
nook_result nook_level_make_of_model(const char *path, nook_level *level);
