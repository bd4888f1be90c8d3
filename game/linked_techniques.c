/* Every technique is linked into the program, by these lines alone. */
#include "game/technique_list.h"
#include "modules/ao_gtao/gtao.h"
#include "modules/ao_hao/hao.h"
#include "modules/ao_hbao/hbao.h"
#include "modules/ao_hsao/hsao.h"
#include "modules/ao_reference/reference.h"
#include "modules/ao_ssao/ssao.h"
#include "modules/ao_volume/volume.h"

/* Not constant, as the code that is loaded while it runs (nook_techniques_list) is one for the whole program. */
nook_technique_list nook_listed_techniques = {
    .items = { &nook_ao_volume_technique, &nook_ao_ssao_technique, &nook_ao_hsao_technique, &nook_ao_hbao_technique,
               &nook_ao_gtao_technique, &nook_ao_hao_technique, &nook_ao_reference_technique },
    .count = 7,
};
