#include "game/option.h"
#include "engine/core/suggestion.h"
#include "game/option_text.h"
#include <assert.h>
#include <stdarg.h>
#include <string.h>

static nook_parse wrong(const nook_usage *usage, nook_arguments *out, const char *format, ...)
    __attribute__((format(printf, 3, 4)));

static nook_parse wrong(const nook_usage *usage, nook_arguments *out, const char *format, ...)
{
    int length = snprintf(out->message, sizeof out->message, "nook %s: ", usage->command);
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(out->message + length, sizeof out->message - (size_t)length, format, arguments);
    va_end(arguments);
    return NOOK_PARSE_WRONG;
}

static const nook_option *find_option(const nook_usage *usage, const char *name, size_t length)
{
    for (size_t i = 0; i < usage->option_count; i++) {
        const nook_option *option = &usage->options[i];
        if (strlen(option->name) == length && memcmp(option->name, name, length) == 0)
            return option;
    }
    return NULL;
}

static nook_parse refuse_unknown(const nook_usage *usage, nook_arguments *out, const char *given, size_t length)
{
    char name[32] = "";
    if (length < sizeof name)
        memcpy(name, given, length);
    nook_suggestion suggestion = nook_suggestion_for(name);
    for (size_t i = 0; i < usage->option_count && *name; i++)
        nook_suggestion_offer(&suggestion, usage->options[i].name);
    if (suggestion.nearest)
        return wrong(usage, out, "--%.*s: no such option; did you mean --%s?", (int)length, given, suggestion.nearest);
    return wrong(usage, out, "--%.*s: no such option; --help lists them", (int)length, given);
}

static nook_parse refuse_text(const nook_usage *usage, nook_arguments *out, const nook_option *option, const char *text)
{
    char expected[256];
    nook_option_describe(option, expected, sizeof expected);
    return wrong(usage, out, "--%s %s: give %s", option->name, *text ? text : "''", expected);
}

/** Reads the option at argv[*at]; moves *at onto its text when that is the next argument. */
static nook_parse read_option(const nook_usage *usage, int argc, char **argv, int *at, nook_arguments *out)
{
    const char *given = argv[*at] + 2;
    const char *equals = strchr(given, '=');
    size_t length = equals ? (size_t)(equals - given) : strlen(given);
    const nook_option *option = find_option(usage, given, length);
    if (!option)
        return refuse_unknown(usage, out, given, length);
    if (option->kind == NOOK_OPTION_FLAG) {
        if (equals)
            return wrong(usage, out, "--%s: takes no value", option->name);
        *(bool *)option->target = true;
        return NOOK_PARSE_RUN;
    }
    const char *text = equals ? equals + 1 : NULL;
    if (!text) {
        if (*at + 1 >= argc) {
            char expected[256];
            nook_option_describe(option, expected, sizeof expected);
            return wrong(usage, out, "--%s: its value is missing; give %s", option->name, expected);
        }
        text = argv[++*at];
    }
    return nook_option_store(option, text) ? NOOK_PARSE_RUN : refuse_text(usage, out, option, text);
}

static nook_parse add_positional(const nook_usage *usage, nook_arguments *out, const char *text)
{
    if (usage->positional_max == 0)
        return wrong(usage, out, "%s: takes no arguments, only options", text);
    if (out->positional_count == usage->positional_max)
        return wrong(usage, out, "%s: one argument too many; usage: nook %s [OPTIONS] %s", text, usage->command,
                     usage->positionals);
    out->positionals[out->positional_count++] = text;
    return NOOK_PARSE_RUN;
}

static bool asks_for_help(int argc, char **argv)
{
    for (int i = 1; i < argc && strcmp(argv[i], "--") != 0; i++) {
        if (strcmp(argv[i], "--help") == 0 || strcmp(argv[i], "-h") == 0)
            return true;
    }
    return false;
}

nook_parse nook_options_parse(const nook_usage *usage, int argc, char **argv, nook_arguments *out)
{
    assert(usage->positional_max <= NOOK_POSITIONAL_MAX);
    *out = (nook_arguments){ 0 };
    if (asks_for_help(argc, argv))
        return NOOK_PARSE_HELP;
    bool only_positionals = false;
    for (int i = 1; i < argc; i++) {
        nook_parse parsed = NOOK_PARSE_RUN;
        if (only_positionals || argv[i][0] != '-' || argv[i][1] == '\0')
            parsed = add_positional(usage, out, argv[i]);
        else if (strcmp(argv[i], "--") == 0)
            only_positionals = true;
        else if (argv[i][1] != '-')
            parsed = wrong(usage, out, "%s: no such option; options start with --", argv[i]);
        else
            parsed = read_option(usage, argc, argv, &i, out);
        if (parsed != NOOK_PARSE_RUN)
            return parsed;
    }
    if (out->positional_count < usage->positional_min)
        return wrong(usage, out, "an argument is missing; usage: nook %s [OPTIONS] %s", usage->command,
                     usage->positionals);
    return NOOK_PARSE_RUN;
}

static void print_option(const nook_option *option, FILE *stream)
{
    char left[64];
    snprintf(left, sizeof left, "--%s%s%s", option->name, option->placeholder ? " " : "",
             option->placeholder ? option->placeholder : "");
    fprintf(stream, "  %-26s %s", left, option->help);
    if (option->kind == NOOK_OPTION_CHOICE)
        fprintf(stream, " (%s)", option->choices);
    else if (option->kind == NOOK_OPTION_LIST)
        fprintf(stream, " (may be repeated)");
    fputc('\n', stream);
}

void nook_options_print_help(const nook_usage *usage, FILE *stream)
{
    fprintf(stream, "usage: nook %s%s%s%s\n\n%s\n\n", usage->command, usage->option_count > 0 ? " [OPTIONS]" : "",
            usage->positionals ? " " : "", usage->positionals ? usage->positionals : "", usage->summary);
    for (size_t i = 0; i < usage->option_count; i++)
        print_option(&usage->options[i], stream);
    fprintf(stream, "  %-26s %s\n", "--help", "print this");
    if (usage->details)
        fprintf(stream, "\n%s", usage->details);
}

bool nook_arguments_read(const nook_usage *usage, int argc, char **argv, nook_arguments *out, int *out_exit_code)
{
    nook_parse parsed = nook_options_parse(usage, argc, argv, out);
    if (parsed == NOOK_PARSE_RUN)
        return true;
    if (parsed == NOOK_PARSE_HELP)
        nook_options_print_help(usage, stdout);
    else
        fprintf(stderr, "%s\n", out->message);
    *out_exit_code = parsed == NOOK_PARSE_HELP ? NOOK_EXIT_OK : NOOK_EXIT_USAGE;
    return false;
}
