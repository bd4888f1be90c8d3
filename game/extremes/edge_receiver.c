#include "game/extremes/edge_receiver.h"
#include "game/settings/setting.h"
#include "game/techniques.h"
#include <assert.h>
#include <stdio.h>
#include <stdlib.h>

nook_result nook_edge_receiver_make(const nook_extremes *extremes, nook_extreme_found *found,
                                    nook_edge_receiver *out_receiver)
{
    *out_receiver = (nook_edge_receiver){ .at = { .normal = { 0, 0, 1 }, .distance = 0.2 }, .found = found };
    nook_fixture_view_desc desc = { .gpu = extremes->gpu, .width = NOOK_EDGE_PIXELS, .height = NOOK_EDGE_PIXELS };
    desc.techniques = nook_techniques(&desc.technique_count);
    return nook_fixture_view_create(&desc, &out_receiver->view);
}

void nook_edge_receiver_free(nook_edge_receiver *receiver)
{
    nook_fixture_view_destroy(receiver->view);
    *receiver = (nook_edge_receiver){ 0 };
}

nook_result nook_edge_receiver_look(const nook_extremes *extremes, nook_extreme_found *found,
                                    nook_result (*look)(const nook_extremes *extremes, nook_edge_receiver *receiver))
{
    nook_edge_receiver receiver;
    nook_result result = nook_edge_receiver_make(extremes, found, &receiver);
    if (result == NOOK_OK)
        result = look(extremes, &receiver);
    nook_edge_receiver_free(&receiver);
    return result;
}

nook_result nook_edge_receiver_set(nook_edge_receiver *receiver, double r_max, const char *format, ...)
{
    char text[NOOK_SETTING_TEXT_MAX];
    nook_setting setting;
    va_list arguments;
    va_start(arguments, format);
    int length = vsnprintf(text, sizeof text, format, arguments);
    va_end(arguments);
    assert(length > 0 && (size_t)length < sizeof text);
    (void)length;
    nook_result result = nook_setting_parse("extremes", text, &setting);
    if (result == NOOK_OK)
        result = nook_setting_assign("extremes", &setting, "ao.filter", "none");
    if (result == NOOK_OK)
        result = nook_setting_apply(receiver->view->ao, &setting);
    if (result == NOOK_OK)
        result = nook_ao_parse_param(receiver->view->ao, "ao.falloff", "hard");
    if (result == NOOK_OK)
        result = nook_ao_set_param(receiver->view->ao, "ao.r_max", r_max);
    if (result == NOOK_OK)
        receiver->technique = setting.technique->name;
    return result;
}

nook_result nook_edge_receiver_add_volume(nook_edge_receiver *receiver, const nook_volume *volume)
{
    nook_fixture_view *view = receiver->view;
    void *bytes;
    size_t size;
    assert(view->occluder_count < view->occluder_capacity);
    nook_ao_occluder occluder = { .world_from_mesh = { 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1 } };
    nook_result result = nook_volume_encode(volume, &bytes, &size);
    if (result != NOOK_OK)
        return result;
    result = nook_ao_add_volume(view->ao, "extremes", bytes, size, &occluder.volume);
    free(bytes);
    if (result == NOOK_OK)
        view->occluders[view->occluder_count++] = occluder;
    return result;
}

nook_result nook_edge_receiver_measure(nook_edge_receiver *receiver, nook_fixture_occlusion *out_occlusion,
                                       const char *format, ...)
{
    char where[sizeof receiver->found->where];
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(where, sizeof where, format, arguments);
    va_end(arguments);
    nook_result result = nook_fixture_measure(receiver->view, receiver->technique, &receiver->at, out_occlusion);
    if (result == NOOK_OK)
        nook_extreme_check_view(receiver->found, receiver->view, "%s", where);
    return result;
}
