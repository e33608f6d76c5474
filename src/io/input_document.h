// SPDX-License-Identifier: GPL-3.0-or-later
// The input file as a tree of values that know where they were written, before anything is known about keys.
#pragma once

#include "model/case.h"

#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace grainfrac {

struct Node {
    enum class Type { table, array, text, integer, floating, boolean, date };
    Type type = Type::table;
    std::string text;
    std::int64_t integer = 0;
    double number = 0.0;  ///< floating
    bool boolean = false;
    std::vector<std::string> keys;  ///< table: in the order of the file, keys[i] names children[i]
    std::vector<Node> children;     ///< of a table or an array
    SourcePlace place;

    const Node* find(std::string_view key) const;
};

/// "a table", "an integer", ...: what the value is, for messages.
const char* type_name(Node::Type type);

/// The file as a tree. Throws InputError, with its line in places[""], if it cannot be read or is not TOML.
Node read_document(const std::string& file, std::map<std::string, SourcePlace>& places);
/// The same of a text; `file` is what messages call it.
Node parse_document(const std::string& text, const std::string& file, std::map<std::string, SourcePlace>& places);

/// A text as a tree; `name`: of its file, for messages. Throws InputError.
Node parse_document(const std::string& text, const std::string& name);

/// Set the value that "key.path=value" names; tables that are not there are made. What is wrong with it goes to
/// problems.
void apply_override(Node& root, const std::string& text, std::vector<InputProblem>& problems,
                    std::map<std::string, SourcePlace>& places);

/// Enter the place of every value under its path, the tables' too.
void collect_places(const Node& node, const std::string& path, std::map<std::string, SourcePlace>& places);

/// "parts[0]" and "side" to "parts[0].side"; a key that is not bare is quoted.
std::string joined(const std::string& path, const std::string& key);
std::string joined(const std::string& path, std::size_t index);
/// "parts[0].side" to "parts[0]" to "parts" to "".
std::string parent_path(const std::string& path);

/// The word that was probably meant, "" if none is near.
std::string nearest(const std::string& word, const std::vector<std::string>& words);

}  // namespace grainfrac
