// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/input_document.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <optional>
#include <stdexcept>
#include <utility>

// toml++ 3.3 breaks a precondition of its own on "[[[": abort() in debug builds, undefined behaviour in release builds.
// Its assertions are made exceptions in both, which needs its header-only form. This is the only file that includes it.
namespace grainfrac {
struct TomlAssertion : std::runtime_error {
    using std::runtime_error::runtime_error;
};
[[noreturn]] static void fail_toml_assertion()
{
    throw TomlAssertion("not TOML: a bracket or a key is out of place");
}
}  // namespace grainfrac
#undef NDEBUG
#undef TOML_SHARED_LIB
#undef TOML_HEADER_ONLY
#define TOML_HEADER_ONLY 1
#define TOML_ASSERT(condition) ((condition) ? static_cast<void>(0) : grainfrac::fail_toml_assertion())
#include <toml++/toml.h>

namespace grainfrac {
namespace {

/// Files above this are no input files [bytes]; a file of this size takes about a second and 1 GiB to read.
constexpr std::size_t max_file_size = 4 << 20;
/// Tables in tables; real files have 4. toml++ limits brackets to 256 but not the dots of a key, and its tables are
/// destroyed by recursion: "a.a.a. ... = 1" with 1e5 dots overflows the stack.
constexpr int max_dots_in_key = 16;
constexpr int max_depth = 64;
constexpr std::size_t max_key_length = 200;
/// Bytes of a value that are kept for messages.
constexpr std::size_t max_source_text = 400;
constexpr std::string_view byte_order_mark = "\xEF\xBB\xBF";

bool is_bare_key_character(char c)
{
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_' || c == '-';
}

/// Index behind the string that opens at text[i]; behind the end of the line or the text if it is not closed.
std::size_t behind_string(std::string_view text, std::size_t i)
{
    const char quote = text[i];
    const bool multi_line = text.substr(i, 3) == std::string(3, quote);
    const std::string_view closing = text.substr(i, multi_line ? 3 : 1);
    for (i += closing.size(); i < text.size(); ++i) {
        if (!multi_line && text[i] == '\n') return i;
        if (text.substr(i, closing.size()) == closing) {
            i += closing.size();
            if (!multi_line) return i;
            for (int more = 0; more < 2 && i < text.size() && text[i] == quote; ++more)
                ++i;  // quotes that end the text
            return i;
        }
        if (text[i] == '\\' && quote == '"') ++i;
    }
    return text.size();
}

struct Objection {
    int line = 0;  ///< 0: none
    std::string message;
};

/// What toml++ must not see: keys of too many parts, and characters beyond ASCII outside texts and comments, where they
/// are an error but make it run into undefined behaviour.
Objection objection_to(std::string_view text)
{
    const auto at = [&](std::size_t i, std::string message) {
        const auto end = text.begin() + static_cast<std::ptrdiff_t>(i);
        return Objection{1 + static_cast<int>(std::count(text.begin(), end, '\n')), std::move(message)};
    };
    int dots = 0;
    for (std::size_t i = text.starts_with(byte_order_mark) ? byte_order_mark.size() : 0; i < text.size();) {
        const char c = text[i];
        if (c == '"' || c == '\'') {
            i = behind_string(text, i);
            continue;
        }
        if (c == '#') {
            i = std::min(text.find('\n', i), text.size());
            continue;
        }
        if (static_cast<unsigned char>(c) >= 0x80) {
            return at(i,
                      "a character that is not ASCII stands outside quotation marks; quantities with units are texts, "
                      "e.g. \"30 µm\"");
        }
        if (std::strchr("\n=,[]{}", c)) dots = 0;
        if (c == '.' && ++dots > max_dots_in_key) {
            return at(i, fmt::format("a key has more than {} parts", max_dots_in_key));
        }
        ++i;
    }
    return {};
}

/// The first line that starts with "[[" and no name behind it, 0 if there is none.
int line_with_broken_header(std::string_view text)
{
    int line = 1;
    while (!text.empty()) {
        const auto end = std::min(text.find('\n'), text.size());
        const std::string_view row = text.substr(0, end);
        const auto bracket = row.find_first_not_of(" \t");
        if (bracket != row.npos && row.substr(bracket, 2) == "[[") {
            const auto name = row.find_first_not_of(" \t", bracket + 2);
            if (name != row.npos && !is_bare_key_character(row[name]) && row[name] != '"' && row[name] != '\'')
                return line;
        }
        text.remove_prefix(std::min(end + 1, text.size()));
        ++line;
    }
    return 0;
}

/// Source text by line and column; toml++ counts columns in code points.
class Lines {
public:
    explicit Lines(std::string_view text) : text_(text)
    {
        if (text_.starts_with(byte_order_mark)) text_.remove_prefix(byte_order_mark.size());
        starts_.push_back(0);
        for (std::size_t i = 0; i < text_.size(); ++i) {
            if (text_[i] == '\n') starts_.push_back(i + 1);
        }
    }

    std::string between(toml::source_position begin, toml::source_position end) const
    {
        const std::size_t from = offset(begin), to = offset(end);
        std::string out(text_.substr(from, to > from ? std::min(to - from, max_source_text) : 0));
        while (!out.empty() && std::strchr(" \t\r\n", out.back())) out.pop_back();
        return out;
    }

private:
    std::size_t offset(toml::source_position p) const
    {
        if (p.line == 0 || p.line > starts_.size()) return text_.size();
        std::size_t i = starts_[p.line - 1];
        for (auto column = p.column; column > 1 && i < text_.size(); --column) {
            do {
                ++i;
            } while (i < text_.size() && (static_cast<unsigned char>(text_[i]) & 0xC0) == 0x80);
        }
        return i;
    }

    std::string_view text_;
    std::vector<std::size_t> starts_;
};

Node converted(const toml::node& from, const Lines& lines, const std::string& file, int depth, int& line)
{
    Node to;
    const toml::source_region& region = from.source();
    to.place.file = file;
    to.place.line = static_cast<int>(region.begin.line);
    if (depth > max_depth) {
        line = to.place.line;
        throw InputError("", fmt::format("tables or arrays are nested deeper than {}", max_depth));
    }
    bool written_as_value = true;
    if (const auto* table = from.as_table()) {
        to.type = Node::Type::table;
        written_as_value = table->is_inline();
        std::vector<std::pair<const toml::key*, const toml::node*>> entries;
        for (const auto& [key, value] : *table) entries.emplace_back(&key, &value);
        std::stable_sort(entries.begin(), entries.end(), [](const auto& a, const auto& b) {
            const auto p = a.first->source().begin, q = b.first->source().begin;
            return std::pair(p.line, p.column) < std::pair(q.line, q.column);
        });
        for (const auto& [key, value] : entries) {
            if (key->str().size() > max_key_length) {
                line = static_cast<int>(key->source().begin.line);
                throw InputError("", fmt::format("a key is longer than {} bytes", max_key_length));
            }
            to.keys.emplace_back(key->str());
            to.children.push_back(converted(*value, lines, file, depth + 1, line));
        }
    } else if (const auto* array = from.as_array()) {
        to.type = Node::Type::array;
        written_as_value = array->empty() || !(array->front().is_table() && !array->front().as_table()->is_inline());
        for (const auto& value : *array) to.children.push_back(converted(value, lines, file, depth + 1, line));
    } else if (const auto* text = from.as_string()) {
        to.type = Node::Type::text;
        to.text = text->get();
    } else if (const auto* integer = from.as_integer()) {
        to.type = Node::Type::integer;
        to.integer = integer->get();
    } else if (const auto* number = from.as_floating_point()) {
        to.type = Node::Type::floating;
        to.number = number->get();
    } else if (const auto* boolean = from.as_boolean()) {
        to.type = Node::Type::boolean;
        to.boolean = boolean->get();
    } else {
        to.type = Node::Type::date;
    }
    if (written_as_value) to.place.text = lines.between(region.begin, region.end);
    return to;
}

/// Throws InputError and sets `line` if the text is not TOML.
Node parsed(std::string_view text, const std::string& file, int& line)
{
    const Objection objection = objection_to(text);
    line = objection.line;
    if (line > 0) throw InputError("", objection.message);
    try {
        const toml::table table = toml::parse(text, std::string_view(file));
        return converted(table, Lines(text), file, 0, line);
    } catch (const toml::parse_error& e) {
        line = static_cast<int>(e.source().begin.line);
        throw InputError("", std::string(e.description()));
    } catch (const TomlAssertion& e) {
        line = line_with_broken_header(text);
        throw InputError("", e.what());
    }
}

std::string contents(const std::string& file)
{
    std::error_code status;
    if (std::filesystem::is_directory(file, status)) throw InputError("", "is a directory; give a TOML file");
    errno = 0;
    std::ifstream in(file, std::ios::binary);
    if (!in) throw InputError("", fmt::format("cannot be opened: {}", std::strerror(errno ? errno : EIO)));
    std::string text;
    std::array<char, 16384> block;
    while (text.size() <= max_file_size && in.read(block.data(), block.size()).gcount() > 0) {
        text.append(block.data(), static_cast<std::size_t>(in.gcount()));
    }
    if (in.bad()) throw InputError("", "cannot be read");
    if (text.size() > max_file_size) {
        throw InputError("", fmt::format("is larger than {} MiB; not an input file", max_file_size >> 20));
    }
    if (text.find_first_not_of(" \t\r\n") == text.npos) throw InputError("", "is empty");
    return text;
}

/// One step of a path: a key, or an index in brackets.
struct Step {
    std::string key;
    std::optional<std::size_t> index;
};

/// Reads "parts[0].region.diameter" up to '='; false if it is not such a path. Leaves `i` at the '='.
bool parse_path(const std::string& text, std::vector<Step>& steps, std::size_t& i)
{
    const auto skip_blanks = [&] {
        while (i < text.size() && (text[i] == ' ' || text[i] == '\t')) ++i;
    };
    while (true) {
        skip_blanks();
        Step step;
        if (i < text.size() && (text[i] == '"' || text[i] == '\'')) {
            const auto close = text.find(text[i], i + 1);
            if (close == text.npos) return false;
            step.key = text.substr(i + 1, close - i - 1);
            i = close + 1;
        } else {
            while (i < text.size() && is_bare_key_character(text[i])) step.key += text[i++];
            if (step.key.empty()) return false;
        }
        if (step.key.size() > max_key_length) return false;
        steps.push_back(step);
        skip_blanks();
        while (i < text.size() && text[i] == '[') {
            const auto close = text.find(']', i);
            const std::string digits = close == text.npos ? "" : text.substr(i + 1, close - i - 1);
            constexpr std::size_t max_digits = 6;
            if (digits.empty() || digits.size() > max_digits || digits.find_first_not_of("0123456789") != digits.npos) {
                return false;
            }
            steps.push_back({"", std::stoul(digits)});
            i = close + 1;
            skip_blanks();
        }
        if (steps.size() > static_cast<std::size_t>(max_dots_in_key)) return false;
        if (i < text.size() && text[i] == '=') return true;
        if (i >= text.size() || text[i] != '.') return false;
        ++i;
    }
}

Node made_for(const Step* next)
{
    Node node;
    node.type = next && next->index ? Node::Type::array : Node::Type::table;
    node.place = {"--set", 0, ""};
    return node;
}

std::string names_in(const Node& array)
{
    std::vector<std::string> names;
    for (const Node& child : array.children) {
        const Node* name = child.find("name");
        if (name && name->type == Node::Type::text) names.push_back('"' + name->text + '"');
    }
    return names.empty() ? "none has a name" : "there are " + fmt::format("{}", fmt::join(names, ", "));
}

/// The node that a path leads to, made where it is missing; throws the message of what is in the way.
Node& follow(Node& root, const std::vector<Step>& steps)
{
    Node* at = &root;
    std::string path;
    for (std::size_t k = 0; k < steps.size(); ++k) {
        const Step* next = k + 1 < steps.size() ? &steps[k + 1] : nullptr;
        const Step& step = steps[k];
        if (step.index) {
            if (at->type != Node::Type::array) {
                throw std::invalid_argument(fmt::format("{} is {}, not an array", path, type_name(at->type)));
            }
            if (*step.index > at->children.size()) {
                throw std::invalid_argument(fmt::format("{} has {} entries; the index must be 0 to {}", path,
                                                        at->children.size(), at->children.size()));
            }
            if (*step.index == at->children.size()) at->children.push_back(made_for(next));
            at = &at->children[*step.index];
            path = joined(path, *step.index);
        } else if (at->type == Node::Type::table) {
            auto found = std::find(at->keys.begin(), at->keys.end(), step.key);
            if (found == at->keys.end()) {
                at->children.push_back(made_for(next));
                found = at->keys.insert(at->keys.end(), step.key);
            }
            at = &at->children[static_cast<std::size_t>(found - at->keys.begin())];
            path = joined(path, step.key);
        } else if (at->type == Node::Type::array) {
            const auto named = std::find_if(at->children.begin(), at->children.end(), [&](const Node& child) {
                const Node* name = child.find("name");
                return name && name->type == Node::Type::text && name->text == step.key;
            });
            if (named == at->children.end()) {
                throw std::invalid_argument(
                    fmt::format("{} has no entry named \"{}\"; {}", path, step.key, names_in(*at)));
            }
            path = joined(path, static_cast<std::size_t>(named - at->children.begin()));
            at = &*named;
        } else {
            throw std::invalid_argument(fmt::format("{} is {}, it has no keys", path, type_name(at->type)));
        }
    }
    return *at;
}

void place_on_command_line(Node& node)
{
    node.place.file = "--set";
    node.place.line = 0;
    for (Node& child : node.children) place_on_command_line(child);
}

std::string trimmed(const std::string& s)
{
    const auto first = s.find_first_not_of(" \t\r\n");
    return first == s.npos ? "" : s.substr(first, s.find_last_not_of(" \t\r\n") - first + 1);
}

/// Edit distance, an exchange of neighbours counting as one edit.
std::size_t edit_distance(const std::string& a, const std::string& b)
{
    std::vector<std::size_t> before(b.size() + 1), last(b.size() + 1), row(b.size() + 1);
    for (std::size_t j = 0; j <= b.size(); ++j) last[j] = j;
    for (std::size_t i = 1; i <= a.size(); ++i) {
        row[0] = i;
        for (std::size_t j = 1; j <= b.size(); ++j) {
            row[j] = std::min({last[j] + 1, row[j - 1] + 1, last[j - 1] + (a[i - 1] == b[j - 1] ? 0 : 1)});
            if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1])
                row[j] = std::min(row[j], before[j - 2] + 1);
        }
        std::swap(before, last);
        std::swap(last, row);
    }
    return last[b.size()];
}

/// For comparing spellings: without case, `-` as `_`.
std::string plain_spelling(std::string s)
{
    for (char& c : s) {
        if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
        if (c == '-' || c == ' ') c = '_';
    }
    return s;
}

}  // namespace

const Node* Node::find(std::string_view key) const
{
    for (std::size_t i = 0; i < keys.size(); ++i) {
        if (keys[i] == key) return &children[i];
    }
    return nullptr;
}

const char* type_name(Node::Type type)
{
    switch (type) {
        case Node::Type::table:
            return "a table";
        case Node::Type::array:
            return "an array";
        case Node::Type::text:
            return "a text";
        case Node::Type::integer:
            return "an integer";
        case Node::Type::floating:
            return "a number with a fraction";
        case Node::Type::boolean:
            return "a boolean";
        case Node::Type::date:
            return "a date or time";
    }
    return "something else";
}

Node read_document(const std::string& file, std::map<std::string, SourcePlace>& places)
{
    const std::string text = contents(file);
    int line = 0;
    try {
        return parsed(text, file, line);
    } catch (const InputError&) {
        places[""] = {file, line, ""};
        throw;
    }
}

Node parse_document(const std::string& text, const std::string& name)
{
    int line = 0;
    return parsed(text, name, line);
}

void apply_override(Node& root, const std::string& text, std::vector<InputProblem>& problems,
                    std::map<std::string, SourcePlace>& places)
{
    std::vector<Step> steps;
    std::size_t at = 0;
    if (!parse_path(text, steps, at)) {
        const std::string key = text.empty() ? "\"\"" : text.substr(0, max_key_length);
        places[key] = {"--set", 0, ""};
        problems.push_back({key, "is not of the form key.path=value, e.g. parts[0].side=\"1 mm\""});
        return;
    }
    const std::string path = trimmed(text.substr(0, at)), value = trimmed(text.substr(at + 1));
    const auto refuse = [&](const std::string& message) {
        places[path] = {"--set", 0, value};
        problems.push_back({path, message});
    };
    Node document;
    try {
        int line = 0;
        document = parsed("value = " + value, "--set", line);
    } catch (const InputError&) {
        return refuse(fmt::format("is not a TOML value; texts need quotes: --set '{}=\"...\"'", path));
    }
    if (document.children.size() != 1 || value.find('\n') != value.npos) return refuse("is more than one TOML value");
    place_on_command_line(document);
    try {
        follow(root, steps) = std::move(document.children.front());
    } catch (const std::invalid_argument& e) {
        refuse(e.what());
    }
}

void collect_places(const Node& node, const std::string& path, std::map<std::string, SourcePlace>& places)
{
    if (!path.empty()) places[path] = node.place;
    for (std::size_t i = 0; i < node.children.size(); ++i) {
        const bool table = node.type == Node::Type::table;
        collect_places(node.children[i], table ? joined(path, node.keys[i]) : joined(path, i), places);
    }
}

std::string joined(const std::string& path, const std::string& key)
{
    const bool bare = !key.empty() && std::all_of(key.begin(), key.end(), is_bare_key_character);
    const std::string step = bare ? key : '"' + key + '"';
    return path.empty() ? step : path + '.' + step;
}

std::string joined(const std::string& path, std::size_t index)
{
    return fmt::format("{}[{}]", path, index);
}

std::string parent_path(const std::string& path)
{
    std::size_t end = path.npos;
    if (path.ends_with(']')) {
        end = path.rfind('[');
    } else if (path.ends_with('"') && path.size() > 1) {
        end = path.rfind(".\"", path.size() - 2);
    } else {
        end = path.rfind('.');
    }
    return end == path.npos ? "" : path.substr(0, end);
}

std::string nearest(const std::string& word, const std::vector<std::string>& words)
{
    constexpr std::size_t longest = 60;
    if (word.empty() || word.size() > longest) return "";
    std::string best;
    std::size_t best_distance = word.size() <= 4 ? 2 : (word.size() <= 8 ? 3 : 4);  // first distance that is too far
    for (const std::string& candidate : words) {
        const std::size_t distance = edit_distance(plain_spelling(word), plain_spelling(candidate));
        if (distance < best_distance && distance < candidate.size()) {
            best = candidate;
            best_distance = distance;
        }
    }
    return best;
}

}  // namespace grainfrac
