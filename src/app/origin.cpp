// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/origin.h"

#include "io/atomic_file.h"
#include "io/input_document.h"
#include "model/checksum.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <map>
#include <stdexcept>
#include <string_view>

namespace grainfrac {

namespace {

/// Every key of a resolved input with its node; what is no table, and no array of them, is a value.
void collect_values(const Node& node, const std::string& path, std::map<std::string, const Node*>& values)
{
    const bool of_tables =
        node.type == Node::Type::array && std::any_of(node.children.begin(), node.children.end(),
                                                      [](const Node& n) { return n.type == Node::Type::table; });
    if (node.type != Node::Type::table && !of_tables) {
        values[path] = &node;
        return;
    }
    for (std::size_t i = 0; i < node.children.size(); ++i)
        collect_values(node.children[i], of_tables ? joined(path, i) : joined(path, node.keys[i]), values);
}

std::map<std::string, const Node*> values_of(const Node& document)
{
    std::map<std::string, const Node*> values;
    collect_values(document, "", values);
    return values;
}

/// Whether a run reads the key anew as it goes: output, when it ends, how long a step is.
bool in_course(std::string_view key)
{
    for (const std::string_view head : {"output.", "test.stop.", "control.time_step"}) {
        if (key.starts_with(head)) return true;
    }
    if (key == "simulation.title") return true;
    if (!key.starts_with("stages[")) return false;
    const std::string_view name = key.substr(key.rfind('.') + 1);
    for (const std::string_view ending :
         {"duration", "load_drop", "load", "stress", "max_displacement", "unbalanced_force_ratio", "rest"}) {
        if (name == ending) return true;
    }
    return false;
}

}  // namespace

RunOrigin origin_of(const Case& c, const std::vector<std::string>& overrides, const std::string& resolved,
                    Device device)
{
    RunOrigin origin;
    const std::filesystem::path input = std::filesystem::absolute(c.file).lexically_normal();
    origin.file = input.string();
    origin.resolved = resolved;
    origin.overrides = overrides;
    origin.device = to_string(device);
    const Node document = parse_document(resolved, "resolved.toml");
    for (const auto& [key, value] : values_of(document)) {
        if (!(key == "file" || key.ends_with(".file")) || value->type != Node::Type::text || value->text.empty())
            continue;
        const std::filesystem::path file = (input.parent_path() / value->text).lexically_normal();
        try {
            const std::string text = read_file(file);
            origin.checksums.push_back(checksum(text.data(), text.size()));
        } catch (const std::runtime_error& e) {
            throw std::runtime_error(fmt::format("{}, which {} names", e.what(), key));
        }
        origin.files.push_back(file.string());
    }
    return origin;
}

std::vector<InputChange> changes(const RunOrigin& before, const RunOrigin& now)
{
    const Node old_document = parse_document(before.resolved, "resolved.toml"),
               new_document = parse_document(now.resolved, "resolved.toml");
    const auto old_values = values_of(old_document), new_values = values_of(new_document);
    std::map<std::string, InputChange> found;
    const auto text = [](const auto& values, const std::string& key) {
        const auto at = values.find(key);
        return at == values.end() ? std::string() : at->second->place.text;
    };
    for (const auto* values : {&old_values, &new_values}) {
        for (const auto& [key, node] : *values) {
            const InputChange change{key, text(old_values, key), text(new_values, key), in_course(key)};
            if (change.before != change.now) found[key] = change;
        }
    }
    std::vector<InputChange> list;
    list.reserve(found.size());
    for (const auto& [key, change] : found) list.push_back(change);
    for (std::size_t i = 0; i < std::min(before.files.size(), now.files.size()); ++i) {
        if (before.files[i] == now.files[i] && before.checksums.at(i) != now.checksums.at(i))
            list.push_back({"contents of " + now.files[i], "", "", false});
    }
    return list;
}

}  // namespace grainfrac
