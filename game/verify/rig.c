#include "game/verify/rig.h"
#include "game/techniques.h"
#include "modules/fixture/draw.h"

static nook_result create_view(nook_gpu *gpu, uint32_t side, nook_fixture_view **out_view)
{
    nook_fixture_view_desc desc = { .gpu = gpu, .width = side, .height = side, .max_occluders = 64 };
    desc.techniques = nook_techniques(&desc.technique_count);
    return nook_fixture_view_create(&desc, out_view);
}

nook_result nook_verify_rig_open(nook_gpu *gpu, nook_verify_rig *out_rig)
{
    nook_verify_rig rig = { 0 };
    nook_result result = create_view(gpu, NOOK_VERIFY_RECEIVER_SIDE, &rig.receiver);
    if (result == NOOK_OK)
        result = create_view(gpu, NOOK_VERIFY_PICTURE_SIDE, &rig.picture);
    if (result != NOOK_OK)
        nook_verify_rig_close(&rig);
    *out_rig = rig;
    return result;
}

void nook_verify_rig_close(nook_verify_rig *rig)
{
    nook_fixture_view_destroy(rig->receiver);
    nook_fixture_view_destroy(rig->picture);
    *rig = (nook_verify_rig){ 0 };
}

nook_result nook_verify_rig_set(nook_verify_rig *rig, const nook_verify_scene *scene, bool with_volumes)
{
    nook_result result = NOOK_OK;
    nook_fixture_view_drop_occluders(rig->receiver);
    for (uint32_t i = 0; result == NOOK_OK && i < scene->object_count; i++)
        result =
            nook_fixture_view_add(rig->receiver, &scene->objects[i], with_volumes ? scene->resolution : 0, NULL, NULL);
    return result;
}

static nook_result apply(nook_ao *ao, const nook_verify_scene *scene, const nook_setting *setting)
{
    nook_result result = nook_setting_apply(ao, setting);
    if (result == NOOK_OK)
        result = nook_ao_set_param(ao, "ao.r_max", scene->r_max);
    if (result == NOOK_OK)
        result = nook_ao_set_param(ao, "ao.falloff", (double)scene->falloff);
    if (result == NOOK_OK)
        result = nook_ao_set_param(ao, "ao.falloff_tau", scene->tau);
    return result;
}

/** What the view shows in a square of pixels. */
static nook_verify_reading read(const nook_fixture_view *view, uint32_t low)
{
    const uint32_t side = NOOK_VERIFY_LOOKED_AT_SIDE;
    nook_verify_reading reading = { .outside = view->outside };
    reading.occlusion = nook_fixture_summarize(view, low, low, low + side, low + side);
    for (uint32_t i = 0; i < NOOK_VERIFY_LOOKED_AT; i++)
        reading.pixels[i] = 1.0 - view->visibility[(low + i / side) * view->width + low + i % side];
    return reading;
}

nook_result nook_verify_rig_measure(nook_verify_rig *rig, const nook_verify_scene *scene, const nook_setting *setting,
                                    nook_verify_reading *out_reading)
{
    const nook_fixture_receiver receiver = { .normal = { 0, 0, 1 }, .distance = 0.05 };
    nook_fixture_occlusion occlusion;
    nook_result result = apply(rig->receiver->ao, scene, setting);
    if (result == NOOK_OK)
        result = nook_fixture_measure(rig->receiver, setting->technique->name, &receiver, &occlusion);
    if (result == NOOK_OK)
        *out_reading = read(rig->receiver, 0);
    return result;
}

nook_result nook_verify_rig_draw(nook_verify_rig *rig, const nook_verify_scene *scene, const nook_verify_camera *camera)
{
    nook_fixture_view *view = rig->picture;
    const nook_fixture_projection projection = { .fov_y_radians = camera->angle, .aspect = 1.0, .z_near = 0.01 };
    view->view_from_world = nook_verify_camera_matrix(camera);
    view->clip_from_view = nook_fixture_projection_matrix(&projection);
    nook_fixture_view_clear(view);
    nook_result result = nook_fixture_view_draw(view, &scene->ground);
    for (uint32_t i = 0; result == NOOK_OK && i < scene->object_count; i++)
        result = nook_fixture_view_draw(view, &scene->objects[i]);
    return result;
}

nook_result nook_verify_rig_look(nook_verify_rig *rig, const nook_verify_scene *scene, const nook_setting *setting,
                                 nook_verify_reading *out_reading)
{
    nook_result result = apply(rig->picture->ao, scene, setting);
    if (result == NOOK_OK)
        result = nook_fixture_view_record(rig->picture, setting->technique->name);
    if (result == NOOK_OK)
        *out_reading = read(rig->picture, NOOK_VERIFY_LOOKED_AT_FROM);
    return result;
}
