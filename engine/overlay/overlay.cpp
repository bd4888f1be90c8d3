// The overlay's frames: Dear ImGui's context fed from nook_input, its triangles handed to the painter. Widgets: overlay_widgets.cpp.
#include "engine/overlay/overlay.h"
#include "engine/core/log.h"
#include "engine/overlay/overlay_internal.h"
#include <cmath>
#include <cstring>
#include <imgui/imgui.h>
#include <new>
#include <unistd.h>

static_assert(sizeof(ImDrawVert) == sizeof(overlay_vertex) && sizeof(ImDrawIdx) == sizeof(uint16_t),
              "the painter takes ImGui's vertices as they are");

static const char font_path[] = "/usr/share/fonts/truetype/dejavu/DejaVuSans.ttf";
static const float letter_pixels = 14.0f; /* height of the font at scale 1 */

struct nook_overlay {
    ImGuiContext *context;
    overlay_painter painter;
    double scale; /* of the font that there is; 0 before the first */
    bool begun;   /* between begin and end */
    bool ended;   /* there is something to draw */
};

/* Its key numbers are ours. */
static void map_keys(ImGuiIO *io)
{
    static const struct {
        ImGuiKey theirs;
        nook_key ours;
    } keys[] = {
        { ImGuiKey_Tab, NOOK_KEY_TAB },
        { ImGuiKey_LeftArrow, NOOK_KEY_LEFT },
        { ImGuiKey_RightArrow, NOOK_KEY_RIGHT },
        { ImGuiKey_UpArrow, NOOK_KEY_UP },
        { ImGuiKey_DownArrow, NOOK_KEY_DOWN },
        { ImGuiKey_Home, NOOK_KEY_HOME },
        { ImGuiKey_End, NOOK_KEY_END },
        { ImGuiKey_Delete, NOOK_KEY_DELETE },
        { ImGuiKey_Backspace, NOOK_KEY_BACKSPACE },
        { ImGuiKey_Enter, NOOK_KEY_ENTER },
        { ImGuiKey_Escape, NOOK_KEY_ESCAPE },
        { ImGuiKey_A, NOOK_KEY_A },
        { ImGuiKey_C, NOOK_KEY_C },
        { ImGuiKey_V, NOOK_KEY_V },
        { ImGuiKey_X, NOOK_KEY_X },
        { ImGuiKey_Y, NOOK_KEY_Y },
        { ImGuiKey_Z, NOOK_KEY_Z },
    };
    for (const auto &key : keys)
        io->KeyMap[key.theirs] = key.ours;
}

nook_result nook_overlay_create(nook_gpu *gpu, nook_overlay **out_overlay)
{
    *out_overlay = nullptr;
    nook_overlay *overlay = new (std::nothrow) nook_overlay();
    if (!overlay)
        return nook_fail(NOOK_E_MEMORY, "overlay: no memory");
    nook_result result = overlay_painter_create(gpu, &overlay->painter);
    if (result != NOOK_OK) {
        delete overlay;
        return result;
    }
    overlay->context = ImGui::CreateContext();
    ImGui::SetCurrentContext(overlay->context);
    ImGuiIO &io = ImGui::GetIO();
    io.IniFilename = nullptr;
    io.LogFilename = nullptr;
    io.BackendFlags |= ImGuiBackendFlags_RendererHasVtxOffset | ImGuiBackendFlags_HasGamepad;
    io.ConfigFlags |= ImGuiConfigFlags_NavEnableGamepad;
    io.ConfigWindowsMoveFromTitleBarOnly = true;
    map_keys(&io);
    *out_overlay = overlay;
    return NOOK_OK;
}

void nook_overlay_destroy(nook_overlay *overlay)
{
    if (!overlay)
        return;
    ImGui::DestroyContext(overlay->context);
    overlay_painter_destroy(&overlay->painter);
    delete overlay;
}

static void set_style(double scale)
{
    ImGuiStyle style;
    ImGui::StyleColorsDark(&style);
    style.WindowRounding = 4.0f;
    style.FrameRounding = 3.0f;
    style.GrabRounding = 3.0f;
    style.WindowBorderSize = 0.0f;
    style.Colors[ImGuiCol_WindowBg].w = 0.86f;
    style.ScaleAllSizes((float)scale);
    ImGui::GetStyle() = style;
}

/* Letters are drawn at the size they are shown at. @return false: the old ones stay */
static bool make_font(nook_overlay *overlay, double scale)
{
    ImGuiIO &io = ImGui::GetIO();
    const float pixels = std::round(letter_pixels * (float)scale);
    unsigned char *rgba8 = nullptr;
    int width = 0, height = 0;
    io.Fonts->Clear();
    ImFont *font = nullptr;
    if (access(font_path, R_OK) == 0)
        font = io.Fonts->AddFontFromFileTTF(font_path, pixels);
    if (!font) {
        ImFontConfig own;
        own.SizePixels = pixels;
        io.Fonts->AddFontDefault(&own);
    }
    io.Fonts->GetTexDataAsRGBA32(&rgba8, &width, &height);
    if (overlay_painter_set_font(&overlay->painter, rgba8, (uint32_t)width, (uint32_t)height) != NOOK_OK)
        return false;
    io.Fonts->SetTexID((ImTextureID)(uintptr_t)overlay->painter.font.id);
    io.Fonts->ClearTexData();
    set_style(scale);
    overlay->scale = scale;
    return true;
}

static void feed_keys(ImGuiIO *io, const nook_input *input)
{
    for (int key = 0; key < NOOK_KEY_COUNT; key++)
        io->KeysDown[key] = input && (input->down[key] || input->pressed[key]); /* a short press counts once */
    io->KeyCtrl = input && input->down[NOOK_KEY_CONTROL];
    io->KeyShift = input && input->down[NOOK_KEY_SHIFT];
    io->KeyAlt = input && input->down[NOOK_KEY_ALT];
    for (int i = 0; input && i < NOOK_INPUT_TYPED_MAX && input->typed[i] != 0; i++)
        io->AddInputCharacter(input->typed[i]);
}

/* Only panels that take a gamepad hear of it. */
static void feed_pad(ImGuiIO *io, const nook_input *input)
{
    const double far = 0.5; /* of a stick's way: it counts as the cross */
    std::memset(io->NavInputs, 0, sizeof io->NavInputs);
    if (!input || !input->pad.present)
        return;
    const nook_gamepad &pad = input->pad;
    io->NavInputs[ImGuiNavInput_Activate] = pad.down[NOOK_PAD_SOUTH];
    io->NavInputs[ImGuiNavInput_Cancel] = pad.down[NOOK_PAD_EAST];
    io->NavInputs[ImGuiNavInput_DpadLeft] = pad.down[NOOK_PAD_LEFT] || pad.left[0] < -far;
    io->NavInputs[ImGuiNavInput_DpadRight] = pad.down[NOOK_PAD_RIGHT] || pad.left[0] > far;
    io->NavInputs[ImGuiNavInput_DpadUp] = pad.down[NOOK_PAD_UP] || pad.left[1] > far;
    io->NavInputs[ImGuiNavInput_DpadDown] = pad.down[NOOK_PAD_DOWN] || pad.left[1] < -far;
}

static void feed_mouse(ImGuiIO *io, const nook_input *input)
{
    const float nowhere = -3.402823466e+38F;
    io->MousePos = input ? ImVec2((float)input->mouse_x, (float)input->mouse_y) : ImVec2(nowhere, nowhere);
    io->MouseWheel = input ? (float)input->scroll : 0.0f;
    for (int i = 0; i < 3; i++)
        io->MouseDown[i] = input && (input->mouse_down[i] || input->mouse_pressed[i]);
}

nook_overlay_taken nook_overlay_begin(nook_overlay *overlay, const nook_overlay_frame *frame)
{
    const double scale = std::fmin(std::fmax(frame->scale, 0.5), 4.0);
    ImGui::SetCurrentContext(overlay->context);
    if (overlay->begun)
        ImGui::EndFrame();
    ImGuiIO &io = ImGui::GetIO();
    if (scale != overlay->scale && !make_font(overlay, scale) && overlay->scale == 0.0)
        io.Fonts->Build(); /* without a texture nothing is seen, but nothing breaks */
    io.DisplaySize = ImVec2((float)frame->width, (float)frame->height);
    io.DeltaTime = frame->seconds > 1e-6 ? (float)frame->seconds : 1e-6f;
    feed_keys(&io, frame->input);
    feed_pad(&io, frame->input);
    feed_mouse(&io, frame->input);
    ImGui::NewFrame();
    overlay->begun = true;
    overlay->ended = false;
    return nook_overlay_taken{ io.WantCaptureMouse, io.WantTextInput };
}

void nook_overlay_end(nook_overlay *overlay)
{
    if (!overlay->begun)
        return;
    ImGui::SetCurrentContext(overlay->context);
    ImGui::Render();
    overlay->begun = false;
    overlay->ended = true;
}

static void draw_commands(overlay_painter *painter, const ImDrawList *list, uint32_t first_vertex, uint32_t first_index)
{
    for (const ImDrawCmd &from : list->CmdBuffer) {
        overlay_command command = {};
        command.clip[0] = from.ClipRect.x, command.clip[1] = from.ClipRect.y;
        command.clip[2] = from.ClipRect.z, command.clip[3] = from.ClipRect.w;
        command.texture = (uint32_t)(uintptr_t)from.GetTexID();
        command.first_index = first_index + from.IdxOffset;
        command.index_count = from.ElemCount;
        command.first_vertex = first_vertex + from.VtxOffset;
        overlay_painter_draw(painter, &command);
    }
}

nook_result nook_overlay_draw(nook_overlay *overlay, nook_framebuffer target)
{
    if (!overlay->ended)
        return NOOK_OK;
    ImGui::SetCurrentContext(overlay->context);
    const ImDrawData *data = ImGui::GetDrawData();
    if (!data || data->TotalIdxCount == 0)
        return NOOK_OK;
    const float size[2] = { data->DisplaySize.x, data->DisplaySize.y };
    nook_result result = overlay_painter_begin(&overlay->painter, target, size, (uint32_t)data->TotalVtxCount,
                                               (uint32_t)data->TotalIdxCount);
    if (result != NOOK_OK)
        return result;
    uint32_t vertex = 0, index = 0;
    for (int i = 0; i < data->CmdListsCount; i++) {
        const ImDrawList *list = data->CmdLists[i];
        overlay_painter_upload(&overlay->painter, reinterpret_cast<const overlay_vertex *>(list->VtxBuffer.Data),
                               vertex, (uint32_t)list->VtxBuffer.Size, list->IdxBuffer.Data, index,
                               (uint32_t)list->IdxBuffer.Size);
        draw_commands(&overlay->painter, list, vertex, index);
        vertex += (uint32_t)list->VtxBuffer.Size;
        index += (uint32_t)list->IdxBuffer.Size;
    }
    overlay_painter_end(&overlay->painter);
    return NOOK_OK;
}
