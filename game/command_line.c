#include "game/command_line.h"
#include <stdbool.h>
#include <string.h>

/* Appends as much as there is room for. */
static void put(char *out, size_t capacity, const char *text, size_t length)
{
    size_t used = strlen(out), room = capacity - used - 1;
    size_t copied = length < room ? length : room;
    memcpy(out + used, text, copied);
    out[used + copied] = '\0';
}

static void put_text(char *out, size_t capacity, const char *text)
{
    put(out, capacity, text, strlen(text));
}

/* Nothing is special between single quotes but their end: a quote itself stands outside of them. */
static void put_quoted(char *out, size_t capacity, const char *argument)
{
    put_text(out, capacity, "'");
    for (const char *c = argument; *c; c++) {
        if (*c == '\'')
            put_text(out, capacity, "'\\''");
        else
            put(out, capacity, c, 1);
    }
    put_text(out, capacity, "'");
}

const char *nook_command_line_join(int argc, char **argv, char *out, size_t capacity)
{
    out[0] = '\0';
    put_text(out, capacity, "./nook");
    for (int i = 0; i < argc; i++) {
        bool plain = argv[i][0] && !strpbrk(argv[i], " \t\n'\"$&|;<>()*?[]#~\\`!{}");
        put_text(out, capacity, " ");
        if (plain)
            put_text(out, capacity, argv[i]);
        else
            put_quoted(out, capacity, argv[i]);
    }
    return out;
}
