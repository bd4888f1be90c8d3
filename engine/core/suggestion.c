#include "engine/core/suggestion.h"
#include <string.h>

int nook_text_distance(const char *a, const char *b)
{
    enum { LONGEST = 31 };
    size_t length_a = strlen(a), length_b = strlen(b);
    if (length_a > LONGEST || length_b > LONGEST)
        return 1000;
    int row[LONGEST + 1]; /* row[j]: distance between the first i letters of a and the first j of b */
    for (size_t j = 0; j <= length_b; j++)
        row[j] = (int)j;
    for (size_t i = 1; i <= length_a; i++) {
        int diagonal = row[0];
        row[0] = (int)i;
        for (size_t j = 1; j <= length_b; j++) {
            int replaced = diagonal + (a[i - 1] != b[j - 1]);
            int shorter = (row[j] < row[j - 1] ? row[j] : row[j - 1]) + 1;
            diagonal = row[j];
            row[j] = replaced < shorter ? replaced : shorter;
        }
    }
    return row[length_b];
}

enum { TOO_FAR = 3 }; /* further off than two letters is not a misspelling */

nook_suggestion nook_suggestion_for(const char *given)
{
    return (nook_suggestion){ .given = given, .distance = TOO_FAR };
}

void nook_suggestion_offer(nook_suggestion *suggestion, const char *name)
{
    int distance = nook_text_distance(name, suggestion->given);
    if (distance >= suggestion->distance || distance >= (int)strlen(name)) /* nothing of a short name may be left */
        return;
    suggestion->nearest = name;
    suggestion->distance = distance;
}
