// SPDX-License-Identifier: GPL-3.0-or-later
// UDUNITS knows the units; what it does not do is done here: fractional powers ("m^0.5"), the symbol "deg", strictness
// about angles (UDUNITS takes rad for a plain number) and about offsets ("degC"), and exact decimal prefixes.
#include "model/units.h"

#include <fmt/format.h>
#include <udunits2.h>

#include <array>
#include <charconv>
#include <cmath>
#include <cstdlib>
#include <memory>
#include <mutex>
#include <optional>
#include <stdexcept>
#include <string_view>
#include <vector>

namespace grainfrac {
namespace {

struct FreeUnit {
    void operator()(ut_unit* u) const { ut_free(u); }
};
using Unit = std::unique_ptr<ut_unit, FreeUnit>;

/// Longest unit text that is looked at; real ones are a tenth of it, and the parser of UDUNITS is kept from more.
constexpr std::size_t max_unit_length = 100;

/// Names of dimensions for messages, by a unit that has it.
struct Dimension {
    const char* unit;
    const char* name;
};
constexpr std::array dimensions{
    Dimension{"m", "a length"},
    Dimension{"kg", "a mass"},
    Dimension{"s", "a time"},
    Dimension{"rad", "an angle"},
    Dimension{"m/s", "a velocity"},
    Dimension{"m/s^2", "an acceleration"},
    Dimension{"rad/s", "an angular velocity"},
    Dimension{"1/s", "a rate"},
    Dimension{"m^2", "an area"},
    Dimension{"m^3", "a volume"},
    Dimension{"kg/m^3", "a density"},
    Dimension{"N", "a force"},
    Dimension{"Pa", "a stress"},
    Dimension{"Pa/m", "a stiffness per area"},
    Dimension{"J", "an energy"},
    Dimension{"J/m^2", "an energy per area"},
    Dimension{"W", "a power"},
    Dimension{"Pa s", "a viscosity"},
    Dimension{"Pa m^0.5", "a stress intensity"},
    Dimension{"K", "a temperature"},
};

/// The unit database, read once. UDUNITS parses with static state: hold `unit_lock` while using it.
std::mutex unit_lock;
ut_system* unit_system()
{
    static ut_system* const system = [] {
        ut_set_error_message_handler(ut_ignore);
        ut_system* s = ut_read_xml(nullptr);
        if (s) {
            const Unit degree(ut_parse(s, "degree", UT_ASCII));
            if (degree) ut_map_symbol_to_unit("deg", UT_ASCII, degree.get());
        }
        return s;
    }();
    if (!system) {
        throw std::runtime_error(
            "the unit database of UDUNITS cannot be read; install libudunits2-data or set "
            "UDUNITS2_XML_PATH to its udunits2.xml");
    }
    return system;
}

std::string_view trimmed(std::string_view s)
{
    const auto first = s.find_first_not_of(" \t\r\n");
    if (first == s.npos) return {};
    return s.substr(first, s.find_last_not_of(" \t\r\n") - first + 1);
}

/// At most 60 bytes for a message, not cut within a character.
std::string shortened(std::string_view s)
{
    std::size_t n = 60;
    if (s.size() <= n) return std::string(s);
    while (n > 0 && (static_cast<unsigned char>(s[n]) & 0xC0) == 0x80) --n;
    return std::string(s.substr(0, n)) + "...";
}

bool is_digit(char c)
{
    return c >= '0' && c <= '9';
}
/// Part of a unit's name: letters, and all of UTF-8 beyond ASCII (µ, °).
bool is_name(char c)
{
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_' || c == '%' ||
           static_cast<unsigned char>(c) >= 0x80;
}

Unit parse_plain(const std::string& text)
{
    std::string clean;  // UDUNITS takes no blanks around an operator
    for (const char c : trimmed(text)) {
        const bool after_operator = !clean.empty() && (clean.back() == '*' || clean.back() == '/');
        if (c == ' ' && after_operator) continue;
        while ((c == '*' || c == '/') && !clean.empty() && clean.back() == ' ') clean.pop_back();
        clean += c;
    }
    return Unit(ut_parse(unit_system(), clean.c_str(), UT_UTF8));
}

/// A factor with a fractional exponent, e.g. "m^0.5" in "MPa m^0.5".
struct RootFactor {
    std::size_t begin, end;  ///< in the text
    std::string base;        ///< "m"
    int twice_exponent;      ///< 1
};

/// Exponent that starts at text[i] (after '^'): "0.5", "-1.5", "(1/2)"; nullopt if it is a whole number, which UDUNITS
/// reads itself. Moves i behind it.
std::optional<double> fractional_exponent(std::string_view text, std::size_t& i)
{
    std::size_t k = i;
    const bool bracket = k < text.size() && text[k] == '(';
    if (bracket) ++k;
    const std::size_t start = k;
    while (k < text.size() &&
           (is_digit(text[k]) || text[k] == '.' || text[k] == '/' || text[k] == '-' || text[k] == '+')) {
        if (text[k] == '/' && !bracket) break;  // "m^2/s"
        ++k;
    }
    std::string_view number = text.substr(start, k - start);
    if (bracket) {
        if (k >= text.size() || text[k] != ')') return std::nullopt;
        ++k;
    } else if (number.find('.') == number.npos) {
        return std::nullopt;
    }
    double value = 0.0;
    const auto [stop, status] = std::from_chars(number.data(), number.data() + number.size(), value);
    if (status != std::errc{}) return std::nullopt;
    const char* const end = number.data() + number.size();
    if (stop != end) {
        double divisor = 0.0;
        if (*stop != '/') return std::nullopt;
        const auto [stop2, status2] = std::from_chars(stop + 1, end, divisor);
        if (status2 != std::errc{} || stop2 != end || divisor == 0.0) return std::nullopt;
        value /= divisor;
    }
    i = k;
    return value;
}

/// All factors with fractional exponents; false if there is one that is not a multiple of 1/2.
bool find_root_factors(std::string_view text, std::vector<RootFactor>& found)
{
    for (std::size_t i = 0; i < text.size();) {
        if (text[i] != '^') {
            ++i;
            continue;
        }
        const std::size_t hat = i++;
        const auto exponent = fractional_exponent(text, i);
        if (!exponent) continue;
        const double twice = 2.0 * *exponent;
        if (std::fabs(twice) > 40.0 || twice != std::round(twice)) return false;
        std::size_t begin = hat;
        if (hat > 0 && text[hat - 1] == ')') {
            int depth = 0;
            while (begin > 0) {
                --begin;
                if (text[begin] == ')') ++depth;
                if (text[begin] == '(' && --depth == 0) break;
            }
            if (depth != 0) return false;
        } else {
            while (begin > 0 && is_name(text[begin - 1])) --begin;
        }
        if (begin == hat) return false;
        found.push_back({begin, i, std::string(text.substr(begin, hat - begin)), static_cast<int>(twice)});
    }
    return true;
}

/// Text with factor `kept` written as its base to the first power and the other root factors as 1.
std::string without_roots(std::string_view text, const std::vector<RootFactor>& roots, std::size_t kept)
{
    std::string out;
    std::size_t at = 0;
    for (std::size_t k = 0; k < roots.size(); ++k) {
        out += text.substr(at, roots[k].begin - at);
        out += k == kept ? " (" + roots[k].base + ") " : std::string(" 1 ");
        at = roots[k].end;
    }
    return out += text.substr(at);
}

/// "√m" and "sqrt(m)" as "m^0.5".
std::string with_roots_spelled_out(std::string text)
{
    for (std::size_t at; (at = text.find("sqrt(")) != text.npos;) {
        const auto close = text.find(')', at);
        if (close == text.npos) break;
        text.insert(close + 1, "^0.5");
        text.replace(at, 4, " ");
    }
    const std::string sign = "√";
    for (std::size_t at; (at = text.find(sign)) != text.npos;) {
        std::size_t end = at + sign.size();
        while (end < text.size() && is_name(text[end])) ++end;
        text.insert(end, "^0.5");
        text.replace(at, sign.size(), " ");
    }
    return text;
}

bool has_matching_brackets(std::string_view text)
{
    int depth = 0;
    for (const char c : text) {
        if (c == '(') ++depth;
        if (c == ')' && --depth < 0) return false;
    }
    return depth == 0;
}

/// True if a number other than 1 stands in the text that is not an exponent: "mm 2", "m since 3", "m^1/2".
bool has_stray_number(std::string_view unit)
{
    for (std::size_t i = 0; i < unit.size(); ++i) {
        if (!is_digit(unit[i])) continue;
        std::size_t start = i;
        while (i + 1 < unit.size() && is_digit(unit[i + 1])) ++i;
        const std::string_view number = unit.substr(start, i - start + 1);
        if (i + 2 < unit.size() && unit[i + 1] == '.' && is_digit(unit[i + 2]))
            return true;  // "m0.5"; "m2.s" is a product
        const char behind = i + 1 < unit.size() ? unit[i + 1] : ' ';
        if (is_name(behind)) return true;  // "1e3"
        if (start > 0 && (unit[start - 1] == '-' || unit[start - 1] == '+')) --start;
        const char before = start > 0 ? unit[start - 1] : ' ';
        const bool exponent = is_name(before) || before == '^' || before == ')';
        if (!exponent && number != "1") return true;
    }
    return false;
}

/// A unit and its square; the square is what exists for units with square roots in them.
struct ParsedUnit {
    Unit plain;    ///< null if the unit has a fractional power
    Unit squared;  ///< null: not a unit
};

ParsedUnit parse_unit(std::string_view as_written)
{
    const std::string text = with_roots_spelled_out(std::string(as_written));
    std::vector<RootFactor> roots;
    if (!find_root_factors(text, roots)) return {};
    const std::string rootless = without_roots(text, roots, roots.size());
    if (has_stray_number(rootless) || !has_matching_brackets(rootless)) return {};
    ParsedUnit parsed;
    Unit rest = parse_plain(rootless);
    if (!rest) return {};
    parsed.squared.reset(ut_raise(rest.get(), 2));
    for (std::size_t k = 0; k < roots.size() && parsed.squared; ++k) {
        const Unit with = parse_plain(without_roots(text, roots, k));
        if (!with) return {};
        const Unit factor(ut_divide(with.get(), rest.get()));  // base or 1/base
        const Unit power(factor ? ut_raise(factor.get(), roots[k].twice_exponent) : nullptr);
        parsed.squared.reset(power ? ut_multiply(parsed.squared.get(), power.get()) : nullptr);
    }
    if (roots.empty()) parsed.plain = std::move(rest);
    return parsed;
}

/// True for numbers without a unit. UDUNITS calls rad dimensionless; its text tells them apart ("0.017 rad", "0.01 1").
bool is_pure_number(const ut_unit* u)
{
    std::array<char, 256> text{};
    const int n = ut_format(u, text.data(), text.size() - 1, UT_ASCII | UT_DEFINITION);
    if (n < 0 || n >= static_cast<int>(text.size()) - 1) return false;
    const std::string_view s(text.data());
    return s == "1" || s.ends_with(" 1");
}

bool same_dimension(const ParsedUnit& a, const ParsedUnit& b)
{
    const Unit ratio(ut_divide(a.squared.get(), b.squared.get()));
    return ratio && is_pure_number(ratio.get());
}

std::string dimension_name(const ParsedUnit& u)
{
    if (is_pure_number(u.squared.get())) return "a number without a unit";
    for (const auto& [unit, name] : dimensions) {
        if (same_dimension(u, parse_unit(unit))) return name;
    }
    return "of another dimension";
}

std::string expected(const std::string& si_unit)
{
    if (si_unit == "1") return "expected a plain number, e.g. \"0.5\"";
    for (const auto& [unit, name] : dimensions) {
        if (si_unit == unit) return fmt::format("expected {}, e.g. \"1 {}\"", name, si_unit);
    }
    return fmt::format("expected a quantity such as \"1 {}\"", si_unit);
}

/// c in y = c x between two units that differ by a factor, nullopt where there is an offset or a logarithm.
std::optional<double> factor_between(ut_unit* from, ut_unit* to)
{
    cv_converter* converter = ut_get_converter(from, to);
    if (!converter) return std::nullopt;
    const double zero = cv_convert_double(converter, 0.0), factor = cv_convert_double(converter, 1.0);
    cv_free(converter);
    if (zero != 0.0 || !std::isfinite(factor) || factor <= 0.0) return std::nullopt;
    return factor;
}

/// A decimal number at the start of a text: digits and exponent apart, so that a prefix can be added to the exponent.
struct Decimal {
    std::string_view digits;  ///< sign and mantissa
    long exponent = 0;
    std::size_t length = 0;  ///< of all of it in the text; 0: no number there
};

Decimal leading_decimal(std::string_view text)
{
    Decimal d;
    std::size_t i = 0, digits = 0;
    if (i < text.size() && (text[i] == '-' || text[i] == '+')) ++i;
    while (i < text.size() && is_digit(text[i])) ++i, ++digits;
    if (i < text.size() && text[i] == '.') {
        ++i;
        while (i < text.size() && is_digit(text[i])) ++i, ++digits;
    }
    if (digits == 0) return d;
    d.digits = text.substr(text[0] == '+' ? 1 : 0, text[0] == '+' ? i - 1 : i);
    if (i < text.size() && (text[i] == 'e' || text[i] == 'E')) {
        std::size_t k = i + 1;
        if (k < text.size() && text[k] == '+') ++k;
        const auto [stop, status] = std::from_chars(text.data() + k, text.data() + text.size(), d.exponent);
        if (status == std::errc::result_out_of_range || std::labs(d.exponent) > 100000) d.exponent = 100000;
        if (status != std::errc::invalid_argument) i = static_cast<std::size_t>(stop - text.data());
    }
    d.length = i;
    return d;
}

/// value * factor; powers of ten go into the exponent, so that "0.6 mm" is the double nearest to 0.0006.
std::optional<double> scaled(const Decimal& d, double factor)
{
    const double power = std::round(std::log10(factor));
    const bool decimal = std::fabs(factor / std::pow(10.0, power) - 1.0) < 1e-13;
    const std::string text = fmt::format("{}e{}", d.digits, d.exponent + (decimal ? static_cast<long>(power) : 0L));
    double value = 0.0;
    const auto [stop, status] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (status != std::errc{} || stop != text.data() + text.size()) return std::nullopt;
    if (!decimal) value *= factor;
    if (!std::isfinite(value)) return std::nullopt;
    return value;
}

}  // namespace

double parse_quantity(const std::string& text, const std::string& si_unit)
{
    const std::lock_guard guard(unit_lock);
    unit_system();
    const auto fail = [&](const std::string& what) {
        throw std::invalid_argument(fmt::format("\"{}\" {}; {}", shortened(text), what, expected(si_unit)));
    };
    const std::string_view quantity = trimmed(text);
    const Decimal number = leading_decimal(quantity);
    if (number.length == 0) fail(quantity.empty() ? "is empty" : "does not start with a number");
    const std::string_view unit = trimmed(quantity.substr(number.length));
    if (unit.starts_with(',')) fail("has a comma; the decimal separator is a point");

    const ParsedUnit si = parse_unit(si_unit);
    if (!si.squared) throw std::logic_error("no unit: " + si_unit);
    double factor = 1.0;
    if (unit.empty()) {
        if (si_unit != "1") fail("has no unit");
    } else {
        const bool plausible = unit.size() <= max_unit_length && unit[0] != '^' && unit.find('@') == unit.npos &&
                               unit.find_first_of("\xC0\xC1\xFE\xFF") == unit.npos && unit.find('\0') == unit.npos;
        const std::string per = unit[0] == '/' ? "1" : "";  // "2 /s"
        const ParsedUnit parsed = plausible ? parse_unit(per + std::string(unit)) : ParsedUnit{};
        if (!parsed.squared) fail(fmt::format("has an unknown unit \"{}\"", shortened(unit)));
        if (!same_dimension(parsed, si)) fail("is " + dimension_name(parsed));
        const auto c = parsed.plain && si.plain ? factor_between(parsed.plain.get(), si.plain.get())
                                                : factor_between(parsed.squared.get(), si.squared.get());
        if (!c) fail("has a unit with an offset or a logarithm");
        factor = parsed.plain && si.plain ? *c : std::sqrt(*c);
    }
    const auto value = scaled(number, factor);
    if (!value) fail("is outside the range of numbers");
    return *value;
}

}  // namespace grainfrac
