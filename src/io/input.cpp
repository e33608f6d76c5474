// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/input.h"

#include "io/input_check.h"
#include "io/input_document.h"
#include "io/input_schema.h"
#include "io/sphere_formats.h"
#include "model/units.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <string_view>
#include <tuple>

namespace grainfrac {
namespace {

using Problems = std::vector<InputProblem>;

std::string wrong_type(const Node& node, const std::string& allowed)
{
    return fmt::format("is {}; must be {}", type_name(node.type), allowed);
}

/// Second walk over a table, when its values are known: what is missing, what has no meaning beside the other values.
class ConditionCheck {
public:
    /// `words_known`: the words that the conditions look at were read; otherwise only unconditional keys are checked.
    ConditionCheck(const Node& node, const std::string& path, bool words_known, Problems& problems)
        : node_(node), path_(path), words_known_(words_known), problems_(problems)
    {
    }

    template <class T>
    void operator()(const char* key, T& member, const Facts& facts)
    {
        check(key, facts, [&] { return expected(member, facts); });
    }
    template <class S>
    void table(const char* key, S&, const Facts& facts)
    {
        check(key, facts, [] { return "a table"; });
    }
    template <class S>
    void array(const char* key, std::vector<S>&, const Facts& facts)
    {
        check(key, facts, [&] { return fmt::format("at least one [[{}]]", key); });
    }
    template <class S>
    void named(const char* key, std::vector<S>&, const Facts& facts)
    {
        check(key, facts, [&] { return fmt::format("at least one [{}.NAME]", key); });
    }

private:
    template <class Expected>
    void check(const char* key, const Facts& facts, const Expected& what)
    {
        const std::string_view used_with = facts.used.text, required_with = facts.required.text;
        if (!words_known_ && !(used_with.empty() && required_with.empty())) return;
        const bool given = node_.find(key) != nullptr;
        if (given && !facts.used.holds && !used_with.empty()) {
            problems_.push_back({joined(path_, key), fmt::format("has no meaning here; it goes with {}", used_with)});
        } else if (!given && facts.required.holds && (facts.used.holds || used_with.empty())) {
            const std::string_view with = required_with.empty() ? used_with : required_with;
            const std::string required = with.empty() ? "required" : fmt::format("required with {}", with);
            problems_.push_back({joined(path_, key), fmt::format("missing; {}: {}", required, what())});
        }
    }

    const Node& node_;
    const std::string& path_;
    bool words_known_;
    Problems& problems_;
};

/// Fills a struct from a table of the file.
class TableReader {
public:
    TableReader(const Node& node, const std::string& path, Problems& problems)
        : node_(node), path_(path), problems_(problems)
    {
    }

    template <class S>
    static void read(const Node& node, const std::string& path, S& spec, Problems& problems)
    {
        TableReader reader(node, path, problems);
        describe(reader, spec);
        reader.report_unknown_keys();
        ConditionCheck conditions(node, path, reader.words_known_, problems);
        describe(conditions, spec);
    }

    template <class T>
    void operator()(const char* key, T& member, const Facts& facts)
    {
        if (const Node* value = look_up(key)) get(*value, joined(path_, key), member, facts);
    }

    template <class S>
    void table(const char* key, S& member, const Facts&)
    {
        const Node* value = look_up(key);
        if (value && is_table(*value, joined(path_, key))) read(*value, joined(path_, key), member, problems_);
    }

    template <class S>
    void array(const char* key, std::vector<S>& member, const Facts&)
    {
        const Node* value = look_up(key);
        if (!value) return;
        const std::string path = joined(path_, key);
        if (value->type != Node::Type::array) {
            return fail(path, wrong_type(*value, fmt::format("an array of tables, [[{}]]", key)));
        }
        for (std::size_t i = 0; i < value->children.size(); ++i) {
            member.emplace_back();
            const std::string entry = joined(path, i);
            if (is_table(value->children[i], entry)) read(value->children[i], entry, member.back(), problems_);
        }
    }

    template <class S>
    void named(const char* key, std::vector<S>& member, const Facts&)
    {
        const Node* value = look_up(key);
        const std::string path = joined(path_, key);
        if (!value || !is_table(*value, path)) return;
        for (std::size_t i = 0; i < value->children.size(); ++i) {
            member.emplace_back();
            member.back().name = value->keys[i];
            const std::string entry = joined(path, value->keys[i]);
            if (is_table(value->children[i], entry)) read(value->children[i], entry, member.back(), problems_);
        }
    }

private:
    const Node* look_up(const char* key)
    {
        known_.emplace_back(key);
        return node_.find(key);
    }

    void fail(const std::string& path, std::string message) { problems_.push_back({path, std::move(message)}); }

    bool is_table(const Node& value, const std::string& path)
    {
        if (value.type != Node::Type::table) fail(path, wrong_type(value, "a table"));
        return value.type == Node::Type::table;
    }

    void report_unknown_keys()
    {
        for (const std::string& key : node_.keys) {
            if (std::find(known_.begin(), known_.end(), key) != known_.end()) continue;
            const std::string near = nearest(key, known_);
            fail(joined(path_, key), near.empty() ? fmt::format("unknown key; known here: {}", fmt::join(known_, ", "))
                                                  : fmt::format("unknown key; did you mean \"{}\"?", near));
        }
    }

    static bool is_auto(const Node& value) { return value.type == Node::Type::text && value.text == "auto"; }

    void get(const Node& value, const std::string& path, double& member, const Facts& facts)
    {
        read_quantity(value, path, member, facts, expected(member, facts));
    }
    void get(const Node& value, const std::string& path, std::optional<double>& member, const Facts& facts)
    {
        member.reset();
        double number = 0.0;
        if (!is_auto(value) && read_quantity(value, path, number, facts, expected(member, facts))) member = number;
    }

    bool read_quantity(const Node& value, const std::string& path, double& member, const Facts& facts,
                       const std::string& allowed)
    {
        double number = 0.0;
        switch (value.type) {
            case Node::Type::integer:
                number = static_cast<double>(value.integer);
                break;
            case Node::Type::floating:
                number = value.number;
                break;
            case Node::Type::text:
                try {
                    number = parse_quantity(value.text, facts.unit);
                } catch (const std::invalid_argument& e) {
                    return fail(path, without_quotation(e.what(), value.text)), false;
                }
                break;
            default:
                return fail(path, wrong_type(value, allowed)), false;
        }
        if (!std::isfinite(number)) return fail(path, "is not a finite number; must be " + allowed), false;
        if (!in_range(number, facts.range)) return fail(path, "must be " + range_text(facts)), false;
        member = number;
        return true;
    }

    /// The message without its repetition of the text, which stands in front of it already.
    static std::string without_quotation(const std::string& message, const std::string& text)
    {
        const std::string quoted = '"' + text + "\" ";
        return message.starts_with(quoted) ? message.substr(quoted.size()) : message;
    }

    void get(const Node& value, const std::string& path, std::int64_t& member, const Facts& facts)
    {
        read_integer(value, path, member, facts, expected(member, facts));
    }
    void get(const Node& value, const std::string& path, std::optional<std::int64_t>& member, const Facts& facts)
    {
        member.reset();
        std::int64_t number = 0;
        if (!is_auto(value) && read_integer(value, path, number, facts, expected(member, facts))) member = number;
    }
    void get(const Node& value, const std::string& path, int& member, const Facts& facts)
    {
        std::int64_t number = member;
        if (!read_integer(value, path, number, facts, expected(member, facts))) return;
        constexpr std::int64_t most = std::numeric_limits<int>::max();
        if (number > most || number < -most) return fail(path, fmt::format("must be >= {} and <= {}", -most, most));
        member = static_cast<int>(number);
    }

    bool read_integer(const Node& value, const std::string& path, std::int64_t& member, const Facts& facts,
                      const std::string& allowed)
    {
        if (value.type != Node::Type::integer) return fail(path, wrong_type(value, allowed)), false;
        if (!in_range(static_cast<double>(value.integer), facts.range)) {
            return fail(path, "must be " + range_text(facts)), false;
        }
        member = value.integer;
        return true;
    }

    void get(const Node& value, const std::string& path, bool& member, const Facts& facts)
    {
        if (value.type != Node::Type::boolean) return fail(path, wrong_type(value, expected(member, facts)));
        member = value.boolean;
    }

    void get(const Node& value, const std::string& path, std::string& member, const Facts& facts)
    {
        const std::vector<Word> words = words_of(facts);
        if (value.type != Node::Type::text) {
            words_known_ = words_known_ && words.empty();
            return fail(path, wrong_type(value, expected(member, facts)));
        }
        if (words.empty()) {
            member = value.text;
            return;
        }
        std::vector<std::string> typed;
        for (const Word& word : words) {
            if (word.typed == value.text) {
                member = word.meant;
                return;
            }
            typed.push_back(word.typed);
        }
        words_known_ = false;
        const std::string near = nearest(value.text, typed);
        fail(path, fmt::format("must be {}{}", expected(member, facts),
                               near.empty() ? "" : fmt::format("; did you mean \"{}\"?", near)));
    }

    void get(const Node& value, const std::string& path, Vec3& member, const Facts& facts)
    {
        if (!is_array_of(value, path, 3, expected(member, facts))) return;
        for (int i = 0; i < 3; ++i) get_element(value, path, static_cast<std::size_t>(i), member[i], facts);
    }
    void get(const Node& value, const std::string& path, std::optional<Vec3>& member, const Facts& facts)
    {
        member.reset();
        Vec3 vector;
        if (is_auto(value) || !is_array_of(value, path, 3, expected(member, facts))) return;
        for (int i = 0; i < 3; ++i) get_element(value, path, static_cast<std::size_t>(i), vector[i], facts);
        member = vector;
    }
    void get(const Node& value, const std::string& path, std::vector<double>& member, const Facts& facts)
    {
        if (value.type != Node::Type::array) {  // one value is a list of one
            member.assign(1, 0.0);
            return get(value, path, member.front(), facts);
        }
        if (!is_array_of(value, path, value.children.size(), expected(member, facts))) return;
        if (value.children.empty()) return fail(path, "is empty; must be " + expected(member, facts));
        member.assign(value.children.size(), 0.0);
        for (std::size_t i = 0; i < member.size(); ++i) get_element(value, path, i, member[i], facts);
    }
    void get(const Node& value, const std::string& path, std::vector<std::string>& member, const Facts& facts)
    {
        if (!is_array_of(value, path, value.children.size(), expected(member, facts))) return;
        if (value.children.empty()) return fail(path, "is empty; must be " + expected(member, facts));
        member.assign(value.children.size(), {});
        for (std::size_t i = 0; i < member.size(); ++i) get_element(value, path, i, member[i], facts);
    }
    void get(const Node& value, const std::string& path, std::vector<Vec3>& member, const Facts& facts)
    {
        if (!is_array_of(value, path, value.children.size(), expected(member, facts))) return;
        member.assign(value.children.size(), {});
        for (std::size_t i = 0; i < member.size(); ++i) get_element(value, path, i, member[i], facts);
    }
    void get(const Node& value, const std::string& path, std::array<std::string, 2>& member, const Facts& facts)
    {
        if (!is_array_of(value, path, 2, expected(member, facts))) return;
        for (std::size_t i = 0; i < 2; ++i) get_element(value, path, i, member[i], facts);
    }

    template <class T>
    void get_element(const Node& array, const std::string& path, std::size_t i, T& member, const Facts& facts)
    {
        get(array.children[i], joined(path, i), member, facts);
    }

    bool is_array_of(const Node& value, const std::string& path, std::size_t size, const std::string& allowed)
    {
        if (value.type != Node::Type::array) return fail(path, wrong_type(value, allowed)), false;
        if (value.children.size() != size) {
            return fail(path, fmt::format("has {} entries; must be {}", value.children.size(), allowed)), false;
        }
        return true;
    }

    const Node& node_;
    const std::string& path_;
    Problems& problems_;
    std::vector<std::string> known_;
    bool words_known_ = true;
};

using Places = std::map<std::string, SourcePlace>;

/// The place of the key or, for a missing one, of the nearest table around it; nullptr if there is none.
const SourcePlace* place_of(const std::string& key, const Places& places, bool& its_own)
{
    its_own = true;
    for (std::string path = key;; path = parent_path(path)) {
        if (const auto found = places.find(path); found != places.end()) return &found->second;
        if (path.empty()) return nullptr;
        its_own = false;
    }
}

/// In the order of the file, overrides last.
void sort_by_line(Problems& problems, const Places& places)
{
    const auto rank = [&](const InputProblem& problem) {
        bool its_own = false;
        const SourcePlace* place = place_of(problem.key, places, its_own);
        return std::tuple(place && place->file == "--set", place ? place->line : 0);
    };
    std::stable_sort(problems.begin(), problems.end(),
                     [&](const InputProblem& a, const InputProblem& b) { return rank(a) < rank(b); });
}

/// One line of printable text: blanks and line ends as one blank, other control characters as '?'.
std::string on_one_line(std::string_view text)
{
    std::string out;
    for (const char c : text) {
        const bool blank = c == ' ' || c == '\t' || c == '\n' || c == '\r';
        if (blank && !out.empty() && out.back() == ' ') continue;
        out += blank ? ' ' : (static_cast<unsigned char>(c) < 0x20 || c == 0x7F ? '?' : c);
    }
    return out;
}

/// At most 80 bytes, not cut within a character.
std::string shortened(const std::string& text)
{
    std::size_t n = 80;
    if (text.size() <= n) return text;
    while (n > 0 && (static_cast<unsigned char>(text[n]) & 0xC0) == 0x80) --n;
    return text.substr(0, n) + "...";
}

}  // namespace

namespace {

Case case_of(Node document, const std::string& file, const std::vector<std::string>& overrides, Places& places_out)
{
    enter_sphere_formats();
    Problems problems;
    Places wrong_overrides;
    for (const std::string& text : overrides) apply_override(document, text, problems, wrong_overrides);
    collect_places(document, "", places_out);
    for (const auto& [key, place] : wrong_overrides) places_out[key] = place;

    Case c;
    TableReader::read(document, "", c, problems);
    c.file = file;
    c.places = places_out;
    check_case(c, problems);
    if (!problems.empty()) {
        sort_by_line(problems, places_out);
        throw InputError(std::move(problems));
    }
    for (PartSpec& part : c.parts) {
        OrientationSpec& o = part.orientation;
        const bool none = o.choices.empty() && o.random.empty() && o.file.empty();
        if (none && part.kind == "grains") o.choices = {0.0};  // aligned with the axes
    }
    return c;
}

}  // namespace

Case read_case(const std::string& file, const std::vector<std::string>& overrides, Places& places_out)
{
    places_out.clear();
    return case_of(read_document(file, places_out), file, overrides, places_out);
}

Case read_case_text(const std::string& text, const std::string& file, const std::vector<std::string>& overrides,
                    Places& places_out)
{
    places_out.clear();
    return case_of(parse_document(text, file, places_out), file, overrides, places_out);
}

std::string render_problems(const Problems& problems, const Places& places, const std::string& file,
                            const char* severity)
{
    std::string out;
    for (const InputProblem& problem : problems) {
        bool its_own = false;
        const SourcePlace* place = place_of(problem.key, places, its_own);
        const bool override_line = place && place->file == "--set";
        std::string head = fmt::format("{}: {}", severity, place ? place->file : file);
        if (place && place->line > 0) head += fmt::format(":{}", place->line);
        if (!problem.key.empty()) head += (override_line ? " " : ": ") + problem.key;
        if (its_own && place && !place->text.empty()) head += " = " + shortened(on_one_line(place->text));
        out += on_one_line(head + ": " + problem.message) + '\n';
    }
    return out;
}

}  // namespace grainfrac
