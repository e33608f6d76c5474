// SPDX-License-Identifier: GPL-3.0-or-later
// A page of PLplot with this project's look: white, readable, colour-blind safe. PLplot is one global plotter, so these
// functions are called from one thread, inside draw_figure.
#pragma once

#include "geometry/vec3.h"

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

namespace grainfrac {

enum class Ink { white, black, grey, light_grey, pale_grey, red, blue, purple, green, orange, sky, brown, yellow };
/// Well-told-apart inks for curves, in turn.
Ink curve_ink(std::size_t i);

/// Stem of the picture files and how they come out: `paint` is called once for stem.svg and once for stem.png. Both are
/// written aside and renamed. Throws std::runtime_error, also for what PLplot would end the program for.
void draw_figure(const std::filesystem::path& stem, const std::function<void()>& paint);

/// Part of the page, in fractions of it.
struct Frame {
    double left = 0.11, right = 0.96, bottom = 0.12, top = 0.90;
};
/// Ranges of the axes.
struct Range {
    double low = 0.0, high = 1.0;
    void add(double value);
    /// Some room at both ends; a range without extent gets one.
    Range widened(double share) const;
};

/// `text` as PLplot takes it: its escape character doubled.
std::string plot_text(const std::string& text);

void draw_title(const std::string& title, const std::string& remark = "");
struct AxesStyle {
    bool logarithmic_x = false;  ///< x is given as its logarithm
    bool grid = true;
};
/// Axes with ticks, numbers and labels; what is drawn next is in their units.
void draw_axes(const Frame& frame, const Range& x, const Range& y, const std::string& x_label,
               const std::string& y_label, const AxesStyle& style = {});
/// The same without anything drawn.
void draw_plain_window(const Frame& frame, const Range& x, const Range& y);
/// In the units of the axes. `justify`: 0 starts at x, 0.5 is centred, 1 ends there.
void draw_text(double x, double y, double justify, double size, const std::string& text);
void draw_line(const std::vector<double>& x, const std::vector<double>& y, Ink ink, double width);
void fill_polygon(const std::vector<double>& x, const std::vector<double>& y, Ink ink);
/// In page fractions; the axes are gone afterwards.
void draw_page_text(double x, double y, double justify, double size, const std::string& text);

struct LegendEntry {
    Ink ink = Ink::black;
    double width = 2.0;
    std::string label;
    bool filled = false;  ///< a patch instead of a line
};
/// Entries below each other from (left, top), in page fractions.
void draw_legend(double left, double top, const std::vector<LegendEntry>& entries);

/// SI prefix that brings `largest` between 1 and 1000.
struct Prefix {
    double factor = 1.0;  ///< multiply SI values by this
    std::string name;     ///< "k", "\u00b5", ...
};
Prefix prefix_for(double largest);
/// "Load [N]" becomes "Load [kN]" with the factor for values up to `largest`; labels without a plain unit (m, N, J, Pa,
/// s) stay.
struct ScaledLabel {
    std::string label;
    double factor = 1.0;
};
ScaledLabel scaled_label(const std::string& label, double largest);

}  // namespace grainfrac
