// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/input_facts.h"

#include <fmt/format.h>

#include <cmath>
#include <string_view>

namespace grainfrac {
namespace {

bool has_unit(const Facts& facts)
{
    return std::string_view(facts.unit) != "1";
}
std::string example(const Facts& facts)
{
    return has_unit(facts) ? fmt::format("\"1 {}\"", facts.unit) : "1";
}
std::string with_range(const std::string& what, const Facts& facts)
{
    const std::string range = range_text(facts);
    return range.empty() ? what : what + ' ' + range;
}

}  // namespace

std::vector<Word> words_of(const Facts& facts)
{
    std::vector<Word> words;
    std::string_view rest = facts.words;
    while (!rest.empty()) {
        const auto bar = rest.find(" | ");
        const std::string_view word = rest.substr(0, bar);
        rest = bar == rest.npos ? std::string_view() : rest.substr(bar + 3);
        const auto equal = word.find(" = ");
        words.push_back(
            {std::string(word.substr(0, equal)), std::string(equal == word.npos ? word : word.substr(equal + 3))});
    }
    return words;
}

bool in_range(double value, const Range& range)
{
    return (range.above ? value > range.least : value >= range.least) &&
           (range.below ? value < range.most : value <= range.most);
}

std::string range_text(const Facts& facts)
{
    const Range& r = facts.range;
    const std::string unit = has_unit(facts) ? std::string(" ") + facts.unit : "";
    const std::string low = std::isinf(r.least) ? "" : fmt::format("{} {}{}", r.above ? ">" : ">=", r.least, unit);
    const std::string high = std::isinf(r.most) ? "" : fmt::format("{} {}{}", r.below ? "<" : "<=", r.most, unit);
    return low + (low.empty() || high.empty() ? "" : " and ") + high;
}

std::string expected(const double&, const Facts& facts)
{
    if (!has_unit(facts)) return with_range("a number", facts);
    return with_range("a quantity", facts) + " such as " + example(facts);
}
std::string expected(const std::optional<double>&, const Facts& facts)
{
    return expected(double{}, facts) + " or \"auto\"";
}
std::string expected(const int&, const Facts& facts)
{
    return with_range("an integer", facts);
}
std::string expected(const std::int64_t&, const Facts& facts)
{
    return with_range("an integer", facts);
}
std::string expected(const std::optional<std::int64_t>&, const Facts& facts)
{
    return with_range("an integer", facts) + " or \"auto\"";
}
std::string expected(const bool&, const Facts&)
{
    return "true or false";
}
std::string expected(const std::string&, const Facts& facts)
{
    std::string list;
    for (const Word& word : words_of(facts)) list += fmt::format("{}\"{}\"", list.empty() ? "" : ", ", word.typed);
    return list.empty() ? "a text" : (list.find(',') == list.npos ? list : "one of " + list);
}
std::string expected(const Vec3&, const Facts& facts)
{
    return fmt::format("an array of 3 such as [{0}, {0}, {0}]", example(facts));
}
std::string expected(const std::optional<Vec3>&, const Facts& facts)
{
    return expected(Vec3{}, facts) + " or \"auto\"";
}
std::string expected(const std::vector<double>&, const Facts& facts)
{
    return expected(double{}, facts) + ", or an array of them";
}
std::string expected(const std::vector<std::string>&, const Facts& facts)
{
    if (facts.words[0] != '\0') return "an array of texts, each " + expected(std::string(), facts);
    return "an array of texts such as [\"{10-10}\"]";
}
std::string expected(const std::vector<Vec3>&, const Facts& facts)
{
    return fmt::format("an array of points such as [[{0}, {0}, {0}]]", example(facts));
}
std::string expected(const std::array<std::string, 2>&, const Facts&)
{
    return "an array of 2 names such as [\"*\", \"*\"]";
}

}  // namespace grainfrac
