// SPDX-License-Identifier: GPL-3.0-or-later
#include "generate/sphere_file.h"

#include "geometry/near_boxes.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <fstream>
#include <map>
#include <set>
#include <stdexcept>
#include <string_view>

namespace grainfrac {

namespace {

/// Nearer centres, over the radius, are the same sphere twice: a bond between them had no direction.
constexpr double same_place = 1e-6;

constexpr const char* columns[4] = {"x_m", "y_m", "z_m", "radius_m"};

std::map<std::string, SphereReader>& formats()
{
    static std::map<std::string, SphereReader> known;
    return known;
}

std::vector<std::string_view> cells(std::string_view line)
{
    std::vector<std::string_view> out;
    for (bool more = true; more;) {
        const auto comma = line.find(',');
        std::string_view cell = line.substr(0, comma);
        while (!cell.empty() && (cell.front() == ' ' || cell.front() == '\t')) cell.remove_prefix(1);
        while (!cell.empty() && (cell.back() == ' ' || cell.back() == '\t' || cell.back() == '\r'))
            cell.remove_suffix(1);
        out.push_back(cell);
        more = comma != line.npos;
        if (more) line.remove_prefix(comma + 1);
    }
    return out;
}

/// Rows of a CSV file, with what went wrong where.
class Table {
public:
    explicit Table(const std::filesystem::path& file) : file_(file), in_(file)
    {
        if (!in_ || std::filesystem::is_directory(file))
            throw std::runtime_error(fmt::format("cannot read \"{}\"", file.string()));
        if (!next()) fail("is empty; the first line must name the columns x_m, y_m, z_m, radius_m");
        header_.assign(row_.begin(), row_.end());
        for (int k = 0; k < 4; ++k) {
            if (index(columns[k]) < 0) {
                fail(
                    fmt::format("has no column {}; the first line must name the columns x_m, y_m, z_m, radius_m, and "
                                "commas part them",
                                columns[k]));
            }
        }
    }
    /// The next line that is not empty; false at the end.
    bool next()
    {
        while (std::getline(in_, text_)) {
            if (++line_ == 1 && text_.starts_with("\xEF\xBB\xBF")) text_.erase(0, 3);  // mark of UTF-8
            row_ = cells(text_);
            if (row_.size() > 1 || !row_[0].empty()) return true;
        }
        return false;
    }
    /// -1: there is none.
    int index(std::string_view column) const
    {
        const auto found = std::find(header_.begin(), header_.end(), column);
        return found == header_.end() ? -1 : static_cast<int>(found - header_.begin());
    }
    std::string_view text(int column) const { return row_[static_cast<std::size_t>(column)]; }
    double number(const char* column) const
    {
        const std::string_view cell = text(index(column));
        double value = 0.0;
        const auto [end, error] = std::from_chars(cell.data(), cell.data() + cell.size(), value);
        if (error != std::errc() || end != cell.data() + cell.size() || !std::isfinite(value))
            fail(fmt::format("\"{}\" in column {} is no finite number", cell, column));
        return value;
    }
    void check_width() const
    {
        if (row_.size() != header_.size())
            fail(fmt::format("has {} cells, the first line {}", row_.size(), header_.size()));
    }
    [[noreturn]] void fail(const std::string& what) const
    {
        throw std::runtime_error(fmt::format("\"{}\", line {}: {}", file_.string(), std::max(line_, 1), what));
    }

private:
    std::filesystem::path file_;
    std::ifstream in_;
    std::string text_;
    int line_ = 0;
    std::vector<std::string_view> row_;
    std::vector<std::string> header_;
};

std::vector<Ball> read_csv(const std::filesystem::path& file, const std::string& part)
{
    Table table(file);
    const int part_column = table.index("part");
    std::set<std::string> parts;
    std::vector<Ball> balls;
    while (table.next()) {
        table.check_width();
        const Ball b{{table.number("x_m"), table.number("y_m"), table.number("z_m")}, table.number("radius_m")};
        if (b.radius <= 0.0) table.fail(fmt::format("radius_m must be > 0, is {}", b.radius));
        if (part_column >= 0) parts.emplace(table.text(part_column));
        if (part_column < 0 || table.text(part_column) == part) balls.push_back(b);
    }
    if (balls.empty() && !parts.empty()) {
        throw std::runtime_error(fmt::format("\"{}\" holds no spheres of part \"{}\"; it holds those of \"{}\"",
                                             file.string(), part, fmt::join(parts, "\", \"")));
    }
    return balls;
}

void check(const std::filesystem::path& file, const std::vector<Ball>& balls)
{
    const auto fail = [&](const std::string& what) {
        throw std::runtime_error(fmt::format("\"{}\" {}", file.string(), what));
    };
    if (balls.empty()) fail("holds no spheres");
    std::vector<Box> boxes;
    for (std::size_t i = 0; i < balls.size(); ++i) {
        const auto& [x, radius] = balls[i];
        if (!(std::isfinite(norm2(x)) && std::isfinite(radius)))
            fail(fmt::format("holds a sphere, number {}, that is not finite", i + 1));
        if (radius <= 0.0) fail(fmt::format("holds a sphere, number {}, of radius {}", i + 1, radius));
        const double r = 0.5 * same_place * radius;
        boxes.push_back({x - Vec3{r, r, r}, x + Vec3{r, r, r}});
    }
    const auto pairs = overlapping_boxes(boxes);
    if (!pairs.empty())
        fail(fmt::format("holds spheres {} and {} at the same place", pairs[0].first + 1, pairs[0].second + 1));
}

}  // namespace

void add_sphere_format(const std::string& extension, SphereReader reader)
{
    formats()[extension] = reader;
}

std::vector<Ball> read_spheres(const std::filesystem::path& file, const std::string& part)
{
    const std::string extension = file.extension().string();
    std::vector<Ball> balls;
    if (extension == ".csv") {
        balls = read_csv(file, part);
    } else if (const auto format = formats().find(extension); format != formats().end()) {
        if (!std::ifstream(file)) throw std::runtime_error(fmt::format("cannot read \"{}\"", file.string()));
        balls = format->second(file);
    } else {
        std::string known = ".csv";
        for (const auto& [name, reader] : formats()) known += ", " + name;
        throw std::runtime_error(fmt::format("the name must end in one of {}", known));
    }
    check(file, balls);
    return balls;
}

void write_spheres(const std::filesystem::path& file, const std::vector<SphereSpec>& spheres,
                   const std::vector<PartSpec>& parts)
{
    const std::filesystem::path aside = file.string() + ".tmp";
    {
        std::ofstream out(aside);
        out << fmt::format("{},part\n", fmt::join(columns, ","));
        for (const SphereSpec& s : spheres) {
            out << fmt::format("{},{},{},{},{}\n", s.position.x, s.position.y, s.position.z, s.radius,
                               parts[static_cast<std::size_t>(s.group)].name);
        }
        if (!out.flush()) throw std::runtime_error(fmt::format("cannot write \"{}\"", aside.string()));
    }
    std::filesystem::rename(aside, file);
}

}  // namespace grainfrac
