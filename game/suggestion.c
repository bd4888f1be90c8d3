#include "game/suggestion.h"
#include "game/option.h"
#include <string.h>

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
