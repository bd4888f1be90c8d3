/* What game.so exports: ./nook play. */
#include "game/play/play_module.h"

NOOK_MODULE_EXPORT const nook_module *nook_module_entry(void);
const nook_module *nook_module_entry(void)
{
    return &nook_play_module;
}
