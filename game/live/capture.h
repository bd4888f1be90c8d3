/**
 * capture.h - pictures one after the other into a folder of PNG files, or into a video by ffmpeg.
 */
#pragma once
#include "engine/core/result.h"
#include <stdbool.h>
#include <stdint.h>

typedef struct nook_capture nook_capture;

typedef struct nook_capture_desc {
    const char
        *path; /**< A name that ends in .mp4, .mkv, .webm or .gif: a video. Else a folder, made when it is not there:
                                 frame_000001.png and so on; what it holds is overwritten by frames of the same number. */
    uint32_t width, height; /**< Of all pictures, pixels. */
    double rate;            /**< Of the video, pictures a second; 0: 30. */
} nook_capture_desc;

/** Whether a name is that of a video. */
bool nook_capture_is_video(const char *path);

/**
 * What can be known before anything is drawn, for who would else find out after minutes of baking: whether the folder can be written to
 * (it is made), whether ffmpeg is there. @return as nook_capture_open
 */
nook_result nook_capture_check(const char *path);

/**
 * @return NOOK_E_IO the folder cannot be made or written to; NOOK_E_NOT_FOUND ffmpeg is not installed (the line says what to do);
 *         NOOK_E_DEVICE it cannot be started; NOOK_E_MEMORY. *out_capture is NULL then
 */
nook_result nook_capture_open(const nook_capture_desc *desc, nook_capture **out_capture);
/** @param rgb  width * height * 3 bytes, top row first @return NOOK_E_IO: it is the last picture that could be taken; close it */
nook_result nook_capture_add(nook_capture *capture, const uint8_t *rgb);
/** Waits until the video is whole. NULL is allowed. @return NOOK_E_IO ffmpeg has failed, or a picture was not taken */
nook_result nook_capture_close(nook_capture *capture);
