// The overlay's widgets: calls of Dear ImGui for the context that nook_overlay_begin has made the current one.
#include "engine/overlay/overlay.h"
#include <cmath>
#include <cstdio>
#include <imgui/imgui.h>
#include <imgui/imgui_internal.h>

enum { FORMAT_SIZE = 64 };

static ImU32 packed(nook_overlay_colour colour)
{
    return IM_COL32(colour.r, colour.g, colour.b, colour.a);
}

/* ---- Panels ------------------------------------------------------------------------------------------------------ */

static ImVec2 place_of(const nook_overlay_panel *panel, ImVec2 *pivot)
{
    const ImVec2 size = ImGui::GetIO().DisplaySize;
    const bool from_right = panel->x < 0.0, from_bottom = panel->y < 0.0;
    *pivot = ImVec2(from_right ? 1.0f : 0.0f, from_bottom ? 1.0f : 0.0f);
    return ImVec2((float)panel->x + (from_right ? size.x : 0.0f), (float)panel->y + (from_bottom ? size.y : 0.0f));
}

/* What is kept of a panel from frame to frame. */
static const ImGuiID target_width = 1, target_height = 2;

/* Never seen before, or the target was of another size then: it is put where it belongs, and sized. */
static bool is_new(ImGuiWindow *known, ImVec2 target)
{
    return !known || known->StateStorage.GetFloat(target_width) != target.x ||
           known->StateStorage.GetFloat(target_height) != target.y;
}

/*
 * What would reach out of the target, because there is more in the panel or somebody has dragged it there, comes back into it: by the
 * size that it had in the last frame. One that was not seen then has none.
 */
static void place_panel(const nook_overlay_panel *panel, ImGuiWindow *known, bool anew)
{
    ImVec2 pivot;
    const ImVec2 target = ImGui::GetIO().DisplaySize, place = place_of(panel, &pivot);
    if (known && known->WasActive && !known->Hidden && (panel->bare || !anew)) {
        const ImVec2 size = known->Size;
        const ImVec2 at = panel->bare ? ImVec2(place.x - pivot.x * size.x, place.y - pivot.y * size.y) : known->Pos;
        const ImVec2 kept(std::fmax(std::fmin(at.x, target.x - size.x), 0.0f),
                          std::fmax(std::fmin(at.y, target.y - size.y), 0.0f));
        if (kept.x != at.x || kept.y != at.y) {
            ImGui::SetNextWindowPos(kept, ImGuiCond_Always);
            return;
        }
    }
    ImGui::SetNextWindowPos(place, panel->bare || anew ? ImGuiCond_Always : ImGuiCond_FirstUseEver, pivot);
}

bool nook_overlay_panel_begin(nook_overlay *overlay, const nook_overlay_panel *panel)
{
    (void)overlay;
    ImGuiWindowFlags flags = ImGuiWindowFlags_NoSavedSettings;
    if (!panel->pad)
        flags |= ImGuiWindowFlags_NoNav;
    if (panel->bare)
        flags |= ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoFocusOnAppearing;
    if (panel->passive)
        flags |= ImGuiWindowFlags_NoInputs;
    if (panel->width <= 0.0)
        flags |= ImGuiWindowFlags_AlwaysAutoResize;
    const float letter = ImGui::GetFontSize();
    const ImVec2 target = ImGui::GetIO().DisplaySize;
    ImGuiWindow *known = ImGui::FindWindowByName(panel->title);
    const bool anew = is_new(known, target);
    place_panel(panel, known, anew);
    if (panel->width > 0.0)
        ImGui::SetNextWindowSize(ImVec2((float)panel->width * letter, (float)panel->height * letter),
                                 anew ? ImGuiCond_Always : ImGuiCond_FirstUseEver);
    ImGui::SetNextWindowSizeConstraints(ImVec2(0.0f, 0.0f), target);
    const bool unfolded = ImGui::Begin(panel->title, panel->open, flags);
    ImGui::GetStateStorage()->SetFloat(target_width, target.x);
    ImGui::GetStateStorage()->SetFloat(target_height, target.y);
    return unfolded;
}

void nook_overlay_panel_end(nook_overlay *overlay)
{
    (void)overlay;
    ImGui::End();
}

/* ---- What only shows --------------------------------------------------------------------------------------------- */

void nook_overlay_text(nook_overlay *overlay, const char *text)
{
    (void)overlay;
    ImGui::TextUnformatted(text);
}

/* A panel that fits itself to what it holds has no room of its own to keep to. */
void nook_overlay_text_wrapped(nook_overlay *overlay, double width, const char *text)
{
    (void)overlay;
    const float wanted = ImGui::GetCursorPosX() + (float)width * ImGui::GetFontSize();
    const bool fits = ImGui::GetCurrentWindow()->Flags & ImGuiWindowFlags_AlwaysAutoResize;
    ImGui::PushTextWrapPos(fits ? wanted : std::fmin(wanted, ImGui::GetContentRegionMax().x));
    ImGui::TextUnformatted(text);
    ImGui::PopTextWrapPos();
}

void nook_overlay_text_coloured(nook_overlay *overlay, nook_overlay_colour colour, const char *text)
{
    (void)overlay;
    ImGui::PushStyleColor(ImGuiCol_Text, packed(colour));
    ImGui::TextUnformatted(text);
    ImGui::PopStyleColor();
}

void nook_overlay_separator(nook_overlay *overlay)
{
    (void)overlay;
    ImGui::Separator();
}

void nook_overlay_same_line(nook_overlay *overlay)
{
    (void)overlay;
    ImGui::SameLine();
}

void nook_overlay_same_line_at(nook_overlay *overlay, double letters)
{
    (void)overlay;
    ImGui::SameLine((float)letters * ImGui::GetFontSize());
}

bool nook_overlay_section(nook_overlay *overlay, const char *label, bool open_at_first)
{
    (void)overlay;
    return ImGui::CollapsingHeader(label, open_at_first ? ImGuiTreeNodeFlags_DefaultOpen : ImGuiTreeNodeFlags_None);
}

void nook_overlay_tooltip(nook_overlay *overlay, const char *text)
{
    (void)overlay;
    if (!ImGui::IsItemHovered())
        return;
    ImGui::BeginTooltip();
    ImGui::PushTextWrapPos(24.0f * ImGui::GetFontSize());
    ImGui::TextUnformatted(text);
    ImGui::PopTextWrapPos();
    ImGui::EndTooltip();
}

void nook_overlay_plot(nook_overlay *overlay, const char *label, const float *values, uint32_t count, uint32_t offset,
                       float low, float high, double height, const char *text)
{
    (void)overlay;
    ImGui::PlotLines(label, values, (int)count, (int)offset, text, low, high,
                     ImVec2(ImGui::GetContentRegionAvail().x, (float)height * ImGui::GetFontSize()));
}

void nook_overlay_image(nook_overlay *overlay, nook_texture texture, double width, double height)
{
    (void)overlay;
    ImGui::Image((ImTextureID)(uintptr_t)texture.id, ImVec2((float)width, (float)height), ImVec2(0.0f, 1.0f),
                 ImVec2(1.0f, 0.0f));
}

/* ---- What answers ------------------------------------------------------------------------------------------------ */

bool nook_overlay_button(nook_overlay *overlay, const char *label)
{
    (void)overlay;
    return ImGui::Button(label);
}

bool nook_overlay_checkbox(nook_overlay *overlay, const char *label, bool *value)
{
    (void)overlay;
    return ImGui::Checkbox(label, value);
}

/* The unit behind the number; a % in it would be taken for a format. */
static const char *format_of(const char *number, const char *unit, char out[FORMAT_SIZE])
{
    std::snprintf(out, FORMAT_SIZE, "%s%s%s%s", number, unit[0] ? " " : "", unit[0] == '%' ? "%" : "", unit);
    return out;
}

static bool slide(const char *label, double *value, double low, double high, const char *unit, ImGuiSliderFlags flags)
{
    char format[FORMAT_SIZE];
    return ImGui::SliderScalar(label, ImGuiDataType_Double, value, &low, &high, format_of("%.4g", unit, format),
                               flags | ImGuiSliderFlags_AlwaysClamp | ImGuiSliderFlags_NoRoundToFormat);
}

bool nook_overlay_slider(nook_overlay *overlay, const char *label, double *value, double low, double high,
                         const char *unit)
{
    (void)overlay;
    return slide(label, value, low, high, unit, ImGuiSliderFlags_None);
}

bool nook_overlay_slider_logarithmic(nook_overlay *overlay, const char *label, double *value, double low, double high,
                                     const char *unit)
{
    (void)overlay;
    return slide(label, value, low, high, unit, ImGuiSliderFlags_Logarithmic);
}

bool nook_overlay_slider_int(nook_overlay *overlay, const char *label, int *value, int low, int high, const char *unit)
{
    (void)overlay;
    char format[FORMAT_SIZE];
    const ImGuiSliderFlags many = high - low > 256 && low > 0 ? ImGuiSliderFlags_Logarithmic : ImGuiSliderFlags_None;
    return ImGui::SliderInt(label, value, low, high, format_of("%d", unit, format),
                            many | ImGuiSliderFlags_AlwaysClamp);
}

/* Copies the index-th of "first|second". @return false past the end */
static bool copy_choice(const char *choices, int index, char out[FORMAT_SIZE])
{
    for (; index > 0 && *choices; choices++)
        index -= *choices == '|';
    size_t length = 0;
    for (; choices[length] && choices[length] != '|' && length + 1 < FORMAT_SIZE; length++)
        out[length] = choices[length];
    out[length] = '\0';
    return length > 0 && index == 0;
}

bool nook_overlay_choice(nook_overlay *overlay, const char *label, int *value, const char *choices)
{
    (void)overlay;
    char name[FORMAT_SIZE];
    bool changed = false;
    copy_choice(choices, *value, name);
    if (!ImGui::BeginCombo(label, name, ImGuiComboFlags_HeightLarge))
        return false;
    for (int i = 0; copy_choice(choices, i, name); i++) {
        if (!ImGui::Selectable(name, i == *value))
            continue;
        changed = i != *value;
        *value = i;
    }
    ImGui::EndCombo();
    return changed;
}

bool nook_overlay_input(nook_overlay *overlay, const char *label, char *text, size_t capacity)
{
    (void)overlay;
    return ImGui::InputText(label, text, capacity, ImGuiInputTextFlags_EnterReturnsTrue);
}

bool nook_overlay_settled(nook_overlay *overlay)
{
    (void)overlay;
    return ImGui::IsItemDeactivatedAfterEdit();
}

bool nook_overlay_busy(nook_overlay *overlay)
{
    (void)overlay;
    return ImGui::IsAnyItemActive();
}

void nook_overlay_place(nook_overlay *overlay, double out_place[4])
{
    (void)overlay;
    const ImVec2 low = ImGui::GetItemRectMin(), size = ImGui::GetItemRectSize();
    out_place[0] = (double)low.x, out_place[1] = (double)low.y;
    out_place[2] = (double)size.x, out_place[3] = (double)size.y;
}

void nook_overlay_push_id(nook_overlay *overlay, int id)
{
    (void)overlay;
    ImGui::PushID(id);
}

void nook_overlay_pop_id(nook_overlay *overlay)
{
    (void)overlay;
    ImGui::PopID();
}

/* ---- Below the panels -------------------------------------------------------------------------------------------- */

static ImVec2 point(const double p[2])
{
    return ImVec2((float)p[0], (float)p[1]);
}

void nook_overlay_line(nook_overlay *overlay, const double from[2], const double to[2], nook_overlay_colour colour,
                       double thickness)
{
    (void)overlay;
    const ImVec2 half(0.5f, 0.5f); /* ImGui adds it */
    const ImVec2 a(point(from).x - half.x, point(from).y - half.y), b(point(to).x - half.x, point(to).y - half.y);
    ImGui::GetBackgroundDrawList()->AddLine(a, b, packed(colour), (float)thickness);
}

void nook_overlay_rectangle(nook_overlay *overlay, const double low[2], const double high[2],
                            nook_overlay_colour colour)
{
    (void)overlay;
    ImGui::GetBackgroundDrawList()->AddRectFilled(point(low), point(high), packed(colour));
}

void nook_overlay_label_size(nook_overlay *overlay, const char *text, double out_size[2])
{
    (void)overlay;
    const ImVec2 size = ImGui::CalcTextSize(text);
    const double margin = (double)ImGui::GetFontSize() * 0.25;
    out_size[0] = (double)size.x + 2.0 * margin, out_size[1] = (double)size.y + margin;
}

double nook_overlay_label(nook_overlay *overlay, const double at[2], nook_overlay_colour colour, const char *text)
{
    double size[2];
    const double margin = (double)ImGui::GetFontSize() * 0.25;
    nook_overlay_label_size(overlay, text, size);
    const double high[2] = { at[0] + size[0], at[1] + size[1] };
    nook_overlay_rectangle(overlay, at, high, nook_overlay_colour{ 15, 15, 15, 176 });
    ImGui::GetBackgroundDrawList()->AddText(ImVec2((float)(at[0] + margin), (float)(at[1] + margin * 0.5)),
                                            packed(colour), text);
    return size[1];
}

size_t nook_overlay_line_length(nook_overlay *overlay, const char *text, double width)
{
    (void)overlay;
    const float room = (float)width - 0.5f * ImGui::GetFontSize(); /* a label's margins */
    size_t best = 0;
    for (size_t at = 0;; at++) {
        if (text[at] != ' ' && text[at] != '\0')
            continue;
        if (best > 0 && ImGui::CalcTextSize(text, text + at).x > room)
            break;
        best = at;
        if (text[at] == '\0')
            break;
    }
    return best;
}

double nook_overlay_letter_height(nook_overlay *overlay)
{
    (void)overlay;
    return (double)ImGui::GetFontSize();
}
