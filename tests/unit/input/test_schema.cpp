// SPDX-License-Identifier: GPL-3.0-or-later
// The JSON schema against every input of the repository, and against wrong ones.
#include "input_files.h"
#include "io/input_document.h"

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <regex>

using namespace grainfrac;
using namespace grainfrac::test;
using nlohmann::json;

namespace {

json as_json(const Node& node)
{
    switch (node.type) {
        case Node::Type::table: {
            json j = json::object();
            for (std::size_t i = 0; i < node.children.size(); ++i) j[node.keys[i]] = as_json(node.children[i]);
            return j;
        }
        case Node::Type::array: {
            json j = json::array();
            for (const Node& child : node.children) j.push_back(as_json(child));
            return j;
        }
        case Node::Type::text:
            return node.text;
        case Node::Type::integer:
            return node.integer;
        case Node::Type::floating:
            return node.number;
        case Node::Type::boolean:
            return node.boolean;
        case Node::Type::date:
            break;
    }
    return nullptr;
}

/// What draft 7 says of the words that the schema uses, and of no others: each unknown one is a failure.
bool conforms(const json& schema, const json& value);

bool keyword_holds(const std::string& word, const json& told, const json& schema, const json& value)
{
    const auto is = [&](const char* type) {
        const std::string name = type;
        return (name == "object" && value.is_object()) || (name == "array" && value.is_array()) ||
               (name == "string" && value.is_string()) || (name == "boolean" && value.is_boolean()) ||
               (name == "integer" && value.is_number_integer()) || (name == "number" && value.is_number());
    };
    if (word == "type") return is(told.get<std::string>().c_str());
    if (word == "enum") return std::find(told.begin(), told.end(), value) != told.end();
    if (word == "const") return value == told;
    if (word == "anyOf")
        return std::any_of(told.begin(), told.end(), [&](const json& one) { return conforms(one, value); });
    if (word == "pattern")
        return !is("string") || std::regex_search(value.get<std::string>(), std::regex(told.get<std::string>()));
    if (word == "minimum") return !is("number") || value.get<double>() >= told.get<double>();
    if (word == "maximum") return !is("number") || value.get<double>() <= told.get<double>();
    if (word == "exclusiveMinimum") return !is("number") || value.get<double>() > told.get<double>();
    if (word == "exclusiveMaximum") return !is("number") || value.get<double>() < told.get<double>();
    if (word == "minItems") return !is("array") || value.size() >= told.get<std::size_t>();
    if (word == "maxItems") return !is("array") || value.size() <= told.get<std::size_t>();
    if (word == "items")
        return !is("array") ||
               std::all_of(value.begin(), value.end(), [&](const json& item) { return conforms(told, item); });
    if (word == "required")
        return !is("object") || std::all_of(told.begin(), told.end(),
                                            [&](const json& key) { return value.contains(key.get<std::string>()); });
    if (word == "properties") {
        if (!is("object")) return true;
        return std::all_of(told.items().begin(), told.items().end(), [&](const auto& entry) {
            return !value.contains(entry.key()) || conforms(entry.value(), value[entry.key()]);
        });
    }
    if (word == "additionalProperties") {
        if (!is("object")) return true;
        return std::all_of(value.items().begin(), value.items().end(), [&](const auto& entry) {
            const bool known = schema.contains("properties") && schema["properties"].contains(entry.key());
            return known || (told.is_boolean() ? told.get<bool>() : conforms(told, entry.value()));
        });
    }
    return word == "description" || word == "default" || word == "title" || word == "$schema";
}

bool conforms(const json& schema, const json& value)
{
    return std::all_of(schema.items().begin(), schema.items().end(),
                       [&](const auto& entry) { return keyword_holds(entry.key(), entry.value(), schema, value); });
}

json document(const std::string& text)
{
    std::map<std::string, SourcePlace> places;
    return as_json(parse_document(text, "FILE", places));
}

const json& schema()
{
    static const json j = json::parse(input_json_schema());
    return j;
}

}  // namespace

TEST_CASE("the schema accepts every input of the repository", "[input]")
{
    int files = 0;
    for (const char* folder : {"/examples", "/microstructures"}) {
        for (const auto& entry : std::filesystem::recursive_directory_iterator(std::string(GF_SOURCE_DIR) + folder)) {
            if (entry.path().extension() != ".toml") continue;
            INFO(entry.path());
            CHECK(conforms(schema(), document(contents(entry.path().string()))));
            ++files;
        }
    }
    CHECK(files > 20);
    for (const std::string& kind : new_case_kinds()) {
        INFO(kind);
        CHECK(conforms(schema(), document(new_case(kind))));
    }
    CHECK(conforms(schema(), document(brazilian_input)));
    CHECK(conforms(schema(), document(custom_input)));
}

TEST_CASE("the schema refuses wrong names, types, words and numbers", "[input]")
{
    const std::string input = brazilian_input;
    const std::pair<const char*, const char*> wrong[] = {
        {"density =", "densty ="},                                   // a key that there is not; density is missing
        {"\"3100 kg/m^3\"", "\"3100\""},                             // no unit
        {"\"3100 kg/m^3\"", "\"much\""},                             // no number
        {"\"3100 kg/m^3\"", "true"},                                 // of another type
        {"\"3100 kg/m^3\"", "0"},                                    // out of range
        {"poisson_ratio = 0.16", "poisson_ratio = 0.5"},             // the limit itself is not allowed
        {"\"brazilian\"", "\"brasilian\""},                          // no such word
        {"between = [\"disc\", \"disc\"]", "between = [\"disc\"]"},  // two names are needed
        {"[materials.sic]", "[materials]\nsic = 1\n[other]"},        // no table
        {"seed = 7", "seed = 7.5"},                                  // no integer
        {"name = \"disc\"\n", ""},                                   // missing
        {"[[contacts]]", "[contacts]"},                              // a table, not an array of them
        {"stop = { load_drop = 0.5 }", "stop = { load_drop = \"half\" }"},
    };
    for (const auto& [from, to] : wrong) {
        INFO(from << " -> " << to);
        CHECK_FALSE(conforms(schema(), document(replaced(input, from, to))));
    }
    CHECK(conforms(schema(), document(replaced(input, "\"3100 kg/m^3\"", "3100"))));
    CHECK(conforms(schema(),
                   document(replaced(input, "friction = 0.3", "residual_friction = \"auto\"\nfriction = 0.3"))));
}

TEST_CASE("the schema tells units, defaults and what is required", "[input]")
{
    const json& material = schema()["properties"]["materials"]["additionalProperties"];
    CHECK(material["required"] == json{"density", "young_modulus", "poisson_ratio"});
    const std::string density = material["properties"]["density"]["description"];
    CHECK(density.find("kg/m^3") != density.npos);
    CHECK(density.find("required") != density.npos);
    const json& bond = schema()["properties"]["bonds"]["items"];
    CHECK_FALSE(bond.contains("required"));
    CHECK(bond["properties"]["damping"]["default"] == BondSpec{}.damping);
    CHECK(bond["properties"]["law"]["enum"] == json{"interface", "parallel", "spring", "point"});
    CHECK(bond["properties"]["normal_stiffness"]["default"] == "auto");
    CHECK_FALSE(bond["properties"]["tensile_strength"].contains("default"));
}
