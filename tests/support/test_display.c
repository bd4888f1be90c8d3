#include "tests/support/test_display.h"
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <sys/wait.h>
#include <unistd.h>

/* Xvfb chooses a free number itself and writes it to this descriptor once it answers. */
static pid_t start_server(int report)
{
    char descriptor[16];
    snprintf(descriptor, sizeof descriptor, "%d", report);
    pid_t child = fork();
    if (child == 0) {
        execlp("Xvfb", "Xvfb", "-displayfd", descriptor, "-screen", "0", "800x600x24", "-nolisten", "tcp",
               (char *)NULL);
        _exit(127);
    }
    return child;
}

bool test_display_open(test_display *out_display)
{
    const char *display = getenv("DISPLAY");
    char number[16], name[24];
    int ends[2];
    *out_display = (test_display){ 0 };
    if (display && *display)
        return true;
    if (pipe(ends) != 0)
        return false;
    pid_t server = start_server(ends[1]);
    close(ends[1]);
    ssize_t size = server > 0 ? read(ends[0], number, sizeof number - 1) : 0; /* 0 as well when the server is gone */
    close(ends[0]);
    if (size <= 0) {
        if (server > 0)
            waitpid(server, NULL, 0);
        return false;
    }
    number[size] = '\0';
    snprintf(name, sizeof name, ":%d", atoi(number));
    setenv("DISPLAY", name, 1);
    out_display->server = server;
    return true;
}

void test_display_close(test_display *display)
{
    if (display->server > 0) {
        kill(display->server, SIGTERM);
        waitpid(display->server, NULL, 0);
        unsetenv("DISPLAY");
    }
    *display = (test_display){ 0 };
}
