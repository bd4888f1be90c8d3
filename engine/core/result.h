#pragma once

/** What a call that can fail returns. Zero is success; a failure is negative and was logged once, where it happened. */
typedef enum nook_result {
    NOOK_OK = 0,
    NOOK_E_ARG = -1,       /**< The caller broke the documented contract. */
    NOOK_E_NOT_FOUND = -2, /**< A name, path or handle that does not exist (any more). */
    NOOK_E_FORMAT = -3,    /**< Bytes that are not the file they claim to be. */
    NOOK_E_VERSION = -4,   /**< The right kind of file or module, made for another version. */
    NOOK_E_RANGE = -5,     /**< A number outside its documented range; nothing was changed. */
    NOOK_E_MEMORY = -6,    /**< No room left in the arena, the pool or the device. */
    NOOK_E_DEVICE = -7,    /**< The graphics driver refused; its message is in the log. */
    NOOK_E_IO = -8,        /**< The file system refused: permission, full disk, a directory where a file should be. */
} nook_result;

/** Elements of an array whose size the compiler knows. */
#define NOOK_COUNT(array) (sizeof(array) / sizeof((array)[0]))
