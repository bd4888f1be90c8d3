/* What game.so exports: ./nook play. */
#include "game/play/play_module.h"
#include "game/technique_list.h"

nook_technique_list nook_listed_techniques = { .count = 0 };

NOOK_MODULE_EXPORT const nook_module *nook_module_entry(void);
const nook_module *nook_module_entry(void)
{
    return &nook_play_module;
}
