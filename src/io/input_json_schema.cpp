// SPDX-License-Identifier: GPL-3.0-or-later
// The key descriptions as a JSON schema (draft 7, which the TOML plug-ins of editors know).
#include "io/input.h"
#include "io/input_schema.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <cmath>
#include <string_view>

namespace grainfrac {
namespace {

using json = nlohmann::ordered_json;

bool has_unit(const Facts& f)
{
    return std::string_view(f.unit) != "1";
}

void add_range(json& j, const Facts& f)
{
    if (!std::isinf(f.range.least)) j[f.range.above ? "exclusiveMinimum" : "minimum"] = f.range.least;
    if (!std::isinf(f.range.most)) j[f.range.below ? "exclusiveMaximum" : "maximum"] = f.range.most;
}

/// A number in SI, or a text: a decimal number and a unit, which only a key with a unit must have.
json quantity(const Facts& f)
{
    json number = {{"type", "number"}};
    add_range(number, f);
    const std::string decimal = R"(^\s*[-+]?([0-9]+\.?[0-9]*|\.[0-9]+)([eE][-+]?[0-9]+)?)";
    const json text = {{"type", "string"},
                       {"pattern", decimal + (has_unit(f) ? R"(\s*[^\s0-9.,].*$)" : R"(\s*\S*\s*$)")}};
    return {{"anyOf", {number, text}}};
}
json integer(const Facts& f)
{
    json j = {{"type", "integer"}};
    add_range(j, f);
    return j;
}
json or_auto(const json& j)
{
    const json automatic = {{"const", "auto"}};
    if (!j.contains("anyOf")) return {{"anyOf", {j, automatic}}};
    json more = j;
    more["anyOf"].push_back(automatic);
    return more;
}
json array_of(const json& items, std::size_t least, std::size_t most = 0)
{
    json j = {{"type", "array"}, {"items", items}, {"minItems", least}};
    if (most > 0) j["maxItems"] = most;
    return j;
}

json type_of(const double&, const Facts& f)
{
    return quantity(f);
}
json type_of(const int&, const Facts& f)
{
    return integer(f);
}
json type_of(const std::int64_t&, const Facts& f)
{
    return integer(f);
}
json type_of(const bool&, const Facts&)
{
    return {{"type", "boolean"}};
}
json type_of(const std::string&, const Facts& f)
{
    json typed = json::array();
    for (const Word& word : words_of(f)) typed.push_back(word.typed);
    if (typed.empty()) return {{"type", "string"}};
    return {{"enum", typed}};
}
json type_of(const Vec3&, const Facts& f)
{
    return array_of(quantity(f), 3, 3);
}
json type_of(const std::array<std::string, 2>&, const Facts&)
{
    return array_of({{"type", "string"}}, 2, 2);
}
json type_of(const std::vector<double>&, const Facts& f)
{
    json j = quantity(f);
    j["anyOf"].push_back(array_of(quantity(f), 1));
    return j;
}
json type_of(const std::vector<std::string>&, const Facts& f)
{
    return array_of(type_of(std::string(), f), 1);
}
json type_of(const std::vector<Vec3>&, const Facts& f)
{
    return array_of(type_of(Vec3{}, f), 0);
}
template <class T>
json type_of(const std::optional<T>&, const Facts& f)
{
    return or_auto(type_of(T{}, f));
}

json value_of(const Vec3& v)
{
    return {v.x, v.y, v.z};
}
template <class T>
json value_of(const T& x)
{
    return x;
}

/// Default of the struct; nothing where a key has none of its own.
template <class T>
void add_default(json& j, const T& member)
{
    j["default"] = value_of(member);
}
template <class T>
void add_default(json& j, const std::optional<T>&)
{
    j["default"] = "auto";
}
void add_default(json& j, const std::string& member)
{
    if (!member.empty()) j["default"] = member;
}
template <class T>
void add_default(json& j, const std::vector<T>& member)
{
    if (!member.empty()) j["default"] = member;
}
void add_default(json&, const std::vector<Vec3>&) {}

bool ever_required(const Facts& f)
{
    return f.required.holds || !std::string_view(f.required.text).empty();
}
/// Whatever the other keys say; the same that the reader asks.
bool always_required(const Facts& f)
{
    return f.required.holds && std::string_view(f.required.text).empty() && std::string_view(f.used.text).empty();
}

std::string description(const Facts& f)
{
    std::string text = f.meaning;
    const std::string_view with = f.used.text, required_with = f.required.text;
    if (has_unit(f)) text += fmt::format(" [{}]", f.unit);
    if (const std::string range = range_text(f); !range.empty()) text += "; " + range;
    if (!with.empty()) text += fmt::format("; with {}", with);
    if (ever_required(f))
        text += required_with.empty() ? "; required" : fmt::format("; required with {}", required_with);
    if (const std::string_view unset = f.unset; !unset.empty()) text += fmt::format("; auto: {}", unset);
    if (const std::string_view source = f.source; !source.empty()) text += fmt::format(" ({})", source);
    return text;
}

class SchemaWriter {
public:
    template <class S>
    static json written(const Facts& facts)
    {
        SchemaWriter writer;
        S spec;
        describe(writer, spec);
        json j = {{"type", "object"}};
        if (const std::string text = description(facts); !text.empty()) j["description"] = text;
        j["properties"] = writer.properties_;
        j["additionalProperties"] = false;
        if (!writer.required_.empty()) j["required"] = writer.required_;
        return j;
    }

    template <class T>
    void operator()(const char* key, const T& member, const Facts& f)
    {
        json j = type_of(member, f);
        j["description"] = description(f);
        if (!ever_required(f)) add_default(j, member);
        enter(key, std::move(j), f);
    }
    template <class S>
    void table(const char* key, S&, const Facts& f)
    {
        enter(key, written<S>(f), f);
    }
    template <class S>
    void array(const char* key, std::vector<S>&, const Facts& f)
    {
        enter(key, {{"type", "array"}, {"description", f.meaning}, {"items", written<S>(f)}}, f);
    }
    template <class S>
    void named(const char* key, std::vector<S>&, const Facts& f)
    {
        enter(key, {{"type", "object"}, {"description", f.meaning}, {"additionalProperties", written<S>(f)}}, f);
    }

private:
    void enter(const char* key, json j, const Facts& f)
    {
        properties_[key] = std::move(j);
        if (always_required(f)) required_.push_back(key);
    }

    json properties_ = json::object(), required_ = json::array();
};

}  // namespace

std::string input_json_schema()
{
    json j = {{"$schema", "http://json-schema.org/draft-07/schema#"}, {"title", "Input file of grainfrac"}};
    const json tables = SchemaWriter::written<Case>({});
    for (const auto& [key, value] : tables.items()) j[key] = value;
    return j.dump(1) + '\n';
}

}  // namespace grainfrac
