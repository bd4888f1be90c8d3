#include "game/option_text.h"
#include <ctype.h>
#include <errno.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

bool nook_text_to_number(const char *text, double *out)
{
    char *end = NULL;
    if (*text == '\0' || isspace((unsigned char)*text))
        return false;
    double value = strtod(text, &end);
    if (*end != '\0' || !isfinite(value))
        return false;
    *out = value;
    return true;
}

bool nook_text_to_int(const char *text, int32_t *out)
{
    char *end = NULL;
    if (*text == '\0' || isspace((unsigned char)*text))
        return false;
    errno = 0;
    long value = strtol(text, &end, 10);
    if (*end != '\0' || errno != 0 || value < INT32_MIN || value > INT32_MAX)
        return false;
    *out = (int32_t)value;
    return true;
}

static bool is_bounded(const nook_option *option)
{
    return option->lowest != 0.0 || option->highest != 0.0;
}

static bool is_in_range(const nook_option *option, double value)
{
    return !is_bounded(option) || (value >= option->lowest && value <= option->highest);
}

static bool store_number(const nook_option *option, const char *text)
{
    double value;
    if (!nook_text_to_number(text, &value) || !is_in_range(option, value))
        return false;
    *(double *)option->target = value;
    return true;
}

static bool store_int(const nook_option *option, const char *text)
{
    int32_t value;
    if (!nook_text_to_int(text, &value) || !is_in_range(option, value))
        return false;
    *(int32_t *)option->target = value;
    return true;
}

static bool store_size(const nook_option *option, const char *text)
{
    char width_text[16];
    const char *cross = strchr(text, 'x');
    if (!cross || (size_t)(cross - text) >= sizeof width_text)
        return false;
    memcpy(width_text, text, (size_t)(cross - text));
    width_text[cross - text] = '\0';
    nook_option_size size;
    if (!nook_text_to_int(width_text, &size.width) || !nook_text_to_int(cross + 1, &size.height))
        return false;
    if (!is_in_range(option, size.width) || !is_in_range(option, size.height))
        return false;
    *(nook_option_size *)option->target = size;
    return true;
}

static bool store_choice(const nook_option *option, const char *text)
{
    int32_t index = 0;
    for (const char *at = option->choices; *at; index++) {
        size_t length = strcspn(at, "|");
        if (strlen(text) == length && memcmp(at, text, length) == 0) {
            *(int32_t *)option->target = index;
            return true;
        }
        at += length + (at[length] == '|');
    }
    return false;
}

static bool store_list(const nook_option *option, const char *text)
{
    nook_option_list *list = option->target;
    if (*text == '\0' || list->count == NOOK_OPTION_LIST_MAX)
        return false;
    list->items[list->count++] = text;
    return true;
}

bool nook_option_store(const nook_option *option, const char *text)
{
    switch (option->kind) {
    case NOOK_OPTION_FLAG:
        return false; /* flags take no text */
    case NOOK_OPTION_TEXT:
        if (*text == '\0')
            return false;
        *(const char **)option->target = text;
        return true;
    case NOOK_OPTION_INT:
        return store_int(option, text);
    case NOOK_OPTION_NUMBER:
        return store_number(option, text);
    case NOOK_OPTION_SIZE:
        return store_size(option, text);
    case NOOK_OPTION_CHOICE:
        return store_choice(option, text);
    case NOOK_OPTION_LIST:
        return store_list(option, text);
    case NOOK_OPTION_CUSTOM:
        return option->read(option->target, text);
    }
    return false;
}

static void describe_number(const nook_option *option, const char *what, char *out, size_t capacity)
{
    if (is_bounded(option) && option->kind == NOOK_OPTION_INT) /* with all of its digits */
        snprintf(out, capacity, "%s from %.0f to %.0f", what, option->lowest, option->highest);
    else if (is_bounded(option))
        snprintf(out, capacity, "%s from %.9g to %.9g", what, option->lowest, option->highest);
    else
        snprintf(out, capacity, "%s", what);
}

static void describe_choices(const nook_option *option, char *out, size_t capacity)
{
    snprintf(out, capacity, "one of %s", option->choices);
    for (char *bar = strchr(out, '|'); bar; bar = strchr(bar, '|'))
        *bar = ' ';
}

void nook_option_describe(const nook_option *option, char *out, size_t capacity)
{
    switch (option->kind) {
    case NOOK_OPTION_FLAG:
        snprintf(out, capacity, "nothing");
        return;
    case NOOK_OPTION_TEXT:
        snprintf(out, capacity, "%s", option->placeholder);
        return;
    case NOOK_OPTION_INT:
        describe_number(option, "a whole number", out, capacity);
        return;
    case NOOK_OPTION_NUMBER:
        describe_number(option, "a number", out, capacity);
        return;
    case NOOK_OPTION_SIZE:
        describe_number(option, "WxH, each", out, capacity);
        return;
    case NOOK_OPTION_CHOICE:
        describe_choices(option, out, capacity);
        return;
    case NOOK_OPTION_LIST:
        snprintf(out, capacity, "%s, at most %d times", option->placeholder, (int)NOOK_OPTION_LIST_MAX);
        return;
    case NOOK_OPTION_CUSTOM:
        snprintf(out, capacity, "%s", option->expects);
        return;
    }
}
