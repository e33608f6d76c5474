// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/figure.h"

#include "io/atomic_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <plplot/plplot.h>
#include <stdexcept>
#include <unistd.h>

namespace grainfrac {

namespace {

constexpr double page_width = 1200.0, page_height = 900.0;  // [pixels]
constexpr double text_size = 5.2;  // [mm] of PLplot's page; smaller is hard to read in a report

struct Rgb {
    int r, g, b;
};
// In the order of Ink; the curves are of the Okabe-Ito set.
constexpr std::array<Rgb, 13> inks{{{255, 255, 255},
                                    {25, 25, 25},
                                    {110, 110, 110},
                                    {190, 190, 190},
                                    {232, 232, 232},
                                    {200, 30, 30},
                                    {0, 90, 180},
                                    {150, 70, 170},
                                    {0, 158, 115},
                                    {230, 140, 0},
                                    {86, 180, 233},
                                    {140, 86, 40},
                                    {220, 200, 40}}};

/// PLplot ends the program after some errors unless a handler leaves otherwise; it is C code compiled with unwind
/// tables, so that an exception passes through it.
int give_up(const char* message)
{
    throw std::runtime_error(std::string("PLplot: ") + message);
}

std::filesystem::path scratch_file()
{
    std::error_code ignored;
    std::string name = (std::filesystem::temp_directory_path(ignored) / "grainfrac_XXXXXX").string();
    const int fd = ::mkstemp(name.data());
    if (fd >= 0) ::close(fd);
    return name;
}

/// Whether PLplot can load the driver; plinit() would ask on the terminal for another.
bool has_device(std::string_view device)
{
    constexpr int room = 64;  // more than PLplot has drivers
    std::array<const char*, room> menu{}, names{};
    const char** menu_begin = menu.data();
    const char** names_begin = names.data();
    int count = room;
    plgFileDevs(&menu_begin, &names_begin, &count);
    return std::any_of(names.begin(), names.begin() + count, [&](const char* name) { return name == device; });
}

void use(Ink ink)
{
    plcol0(static_cast<PLINT>(ink));
}

bool ends_with(const std::string& text, const std::string& tail)
{
    const std::size_t end = text.find_last_not_of("\r\n ");
    return end != std::string::npos && std::string_view(text).substr(0, end + 1).ends_with(tail);
}

void draw_to(const std::filesystem::path& path, const char* device, const std::string& tail,
             const std::function<void()>& paint)
{
    const std::string temporary = aside(path).string();
    // What PLplot cannot cope with, it answers by asking on the terminal or by a crash: look first.
    constexpr std::size_t room = 65536;  // [B] more than PLplot's list of drivers, which it puts into a temporary file
    reserve_room(temporary, room);
    reserve_room(scratch_file(), room);
    if (!has_device(device))
        throw std::runtime_error(fmt::format("{}: PLplot has no driver {}", path.string(), device));
    const auto discard = [&] {
        std::error_code ignored;
        std::filesystem::remove(temporary, ignored);
    };
    std::array<PLINT, inks.size()> red{}, green{}, blue{};
    for (std::size_t i = 0; i < inks.size(); ++i) {
        red[i] = inks[i].r;
        green[i] = inks[i].g;
        blue[i] = inks[i].b;
    }
    plsexit(give_up);
    try {
        plsdev(device);
        plsfnam(temporary.c_str());
        plspage(0.0, 0.0, static_cast<PLINT>(page_width), static_cast<PLINT>(page_height), 0, 0);
        plscmap0(red.data(), green.data(), blue.data(), static_cast<PLINT>(inks.size()));
        plinit();
        plfontld(0);
        plsmaj(0.0, 0.6);
        plsmin(0.0, 0.6);
        plschr(text_size, 1.0);
        pladv(0);
        paint();
        plend();
    } catch (const std::exception& error) {
        plend();
        discard();
        throw std::runtime_error(path.string() + ": " + error.what());
    }
    // The drivers do not report a full disk: see whether the end of the file is there.
    if (!ends_with(read_file(temporary), tail)) {
        discard();
        throw std::runtime_error(path.string() + ": PLplot could not write it whole");
    }
    commit_file(path);
}

}  // namespace

Ink curve_ink(std::size_t i)
{
    constexpr std::array turn{Ink::blue, Ink::red,   Ink::green, Ink::orange, Ink::purple,
                              Ink::sky,  Ink::brown, Ink::grey,  Ink::yellow};
    return turn[i % turn.size()];
}

void draw_figure(const std::filesystem::path& stem, const std::function<void()>& paint)
{
    draw_to(stem.string() + ".svg", "svgcairo", "</svg>", paint);
    draw_to(stem.string() + ".png", "pngcairo", "IEND\xae\x42\x60\x82", paint);
}

void Range::add(double value)
{
    if (!std::isfinite(value)) return;
    low = std::min(low, value);
    high = std::max(high, value);
}

Range Range::widened(double share) const
{
    if (!(high > low)) {
        const double half = low != 0.0 && std::isfinite(low) ? 0.5 * std::fabs(low) : 0.5;
        const double middle = std::isfinite(low) ? low : 0.0;
        return {middle - half, middle + half};
    }
    return {low - share * (high - low), high + share * (high - low)};
}

std::string plot_text(const std::string& text)
{
    std::string result;
    for (const char c : text) result += c == '#' ? std::string("##") : std::string(1, c);
    return result;
}

void draw_text(double x, double y, double justify, double size, const std::string& text)
{
    plschr(text_size, size);
    plptex(x, y, 1.0, 0.0, justify, plot_text(text).c_str());
    plschr(text_size, 1.0);
}

void draw_plain_window(const Frame& frame, const Range& x, const Range& y)
{
    plvpor(frame.left, frame.right, frame.bottom, frame.top);
    plwind(x.low, x.high, y.low, y.high);
}

void draw_page_text(double x, double y, double justify, double size, const std::string& text)
{
    draw_plain_window({0.0, 1.0, 0.0, 1.0}, {0.0, 1.0}, {0.0, 1.0});
    draw_text(x, y, justify, size, text);
}

void draw_title(const std::string& title, const std::string& remark)
{
    use(Ink::black);
    draw_page_text(0.5, remark.empty() ? 0.95 : 0.965, 0.5, 1.2, title);
    use(Ink::grey);
    if (!remark.empty()) draw_page_text(0.5, 0.925, 0.5, 0.8, remark);
    use(Ink::black);
}

void draw_axes(const Frame& frame, const Range& x, const Range& y, const std::string& x_label,
               const std::string& y_label, const AxesStyle& style)
{
    draw_plain_window(frame, x, y);
    plwidth(1.0);
    use(Ink::pale_grey);
    if (style.grid) plbox(style.logarithmic_x ? "lgt" : "gt", 0.0, 0, "gt", 0.0, 0);
    use(Ink::black);
    plbox(style.logarithmic_x ? "bclnst" : "bcnst", 0.0, 0, "bcnstv", 0.0, 0);
    plmtex("b", 3.2, 0.5, 0.5, plot_text(x_label).c_str());
    plmtex("l", 4.4, 0.5, 0.5, plot_text(y_label).c_str());
}

void draw_line(const std::vector<double>& x, const std::vector<double>& y, Ink ink, double width)
{
    use(ink);
    plwidth(width);
    std::vector<double> px, py;
    const auto flush = [&] {
        if (px.size() > 1) plline(static_cast<PLINT>(px.size()), px.data(), py.data());
        px.clear();
        py.clear();
    };
    for (std::size_t i = 0; i < std::min(x.size(), y.size()); ++i) {
        if (!std::isfinite(x[i]) || !std::isfinite(y[i])) {
            flush();
            continue;
        }
        px.push_back(x[i]);
        py.push_back(y[i]);
    }
    flush();
    plwidth(1.0);
    use(Ink::black);
}

void fill_polygon(const std::vector<double>& x, const std::vector<double>& y, Ink ink)
{
    use(ink);
    plpsty(0);
    if (x.size() > 2) plfill(static_cast<PLINT>(x.size()), x.data(), y.data());
    use(Ink::black);
}

void draw_legend(double left, double top, const std::vector<LegendEntry>& entries)
{
    constexpr double line_height = 0.042, sample = 0.035, gap = 0.012;  // of the page
    for (std::size_t i = 0; i < entries.size(); ++i) {
        const double y = top - line_height * static_cast<double>(i);
        const LegendEntry& entry = entries[i];
        draw_plain_window({0.0, 1.0, 0.0, 1.0}, {0.0, 1.0}, {0.0, 1.0});
        if (entry.filled) {
            const double h = 0.011;
            fill_polygon({left, left + sample, left + sample, left}, {y - h, y - h, y + h, y + h}, entry.ink);
        } else {
            draw_line({left, left + sample}, {y, y}, entry.ink, entry.width);
        }
        draw_page_text(left + sample + gap, y, 0.0, 0.85, entry.label);
    }
}

Prefix prefix_for(double largest)
{
    constexpr std::array<const char*, 9> names{"p", "n", "\u00b5", "m", "", "k", "M", "G", "T"};
    if (!(largest > 0.0) || !std::isfinite(largest)) return {};
    // A little below the power counts as the power: 1000 that lost its last bit is 1 k.
    const int thousands = static_cast<int>(std::floor(std::log10(largest * (1.0 + 1e-9)) / 3.0));
    const int index = std::clamp(thousands + 4, 0, static_cast<int>(names.size()) - 1);
    return {std::pow(10.0, -3.0 * (index - 4)), names[static_cast<std::size_t>(index)]};
}

ScaledLabel scaled_label(const std::string& label, double largest)
{
    const std::size_t open = label.rfind('[');
    if (open == std::string::npos || label.empty() || label.back() != ']') return {label, 1.0};
    const std::string unit = label.substr(open + 1, label.size() - open - 2);
    constexpr std::array plain{"m", "N", "J", "Pa", "s"};
    if (std::find(plain.begin(), plain.end(), unit) == plain.end()) return {label, 1.0};
    const Prefix prefix = prefix_for(largest);
    return {label.substr(0, open + 1) + prefix.name + unit + "]", prefix.factor};
}

}  // namespace grainfrac
