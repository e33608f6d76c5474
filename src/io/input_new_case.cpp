// SPDX-License-Identifier: GPL-3.0-or-later
// Start files: a start's own values, and as comments every other key that goes with them, from the key descriptions.
#include "io/input.h"
#include "io/input_document.h"
#include "io/input_schema.h"
#include "io/input_starts.h"
#include "io/toml_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>
#include <string_view>

namespace grainfrac {
namespace {

/// Of the file; longer comments stand on lines of their own.
constexpr std::size_t line_width = 120;

std::string comment(const Facts& f, bool of_default, bool required)
{
    std::string text = f.meaning, words;
    for (const Word& word : words_of(f)) words += (words.empty() ? "" : " | ") + word.typed;
    const std::string range = range_text(f);
    if (std::string_view(f.unit) != "1" && range.empty()) text += fmt::format(" [{}]", f.unit);
    if (!words.empty() || !range.empty()) text += "; " + (words.empty() ? range : words);
    if (required) text += "; required";
    if (const std::string_view unset = f.unset; of_default && !unset.empty()) text += fmt::format("; auto: {}", unset);
    return text;
}

/// Comment lines of at most line_width.
std::string wrapped(const std::string& text)
{
    std::string out, line = "#";
    for (std::size_t i = 0; i < text.size();) {
        const std::size_t end = std::min(text.find(' ', i), text.size());
        const std::string word = text.substr(i, end - i);
        if (line.size() + 1 + word.size() > line_width) {
            out += line + '\n';
            line = "#";
        }
        line += ' ' + word;
        i = end + 1;
    }
    return out + line + '\n';
}

/// A default as it would be typed; of a key that has none, its place.
template <class T>
std::string shown(const T& member)
{
    return toml_text(member);
}
std::string shown(const std::string& member)
{
    return member.empty() ? "\"...\"" : toml_text(member);
}
template <class T>
std::string shown(const std::vector<T>& member)
{
    return member.empty() ? "[...]" : toml_text(member);
}

/// Writes a table of the start with what else it could hold.
class StartWriter {
public:
    StartWriter(const Node* node, std::string path) : node_(node), path_(std::move(path)) {}

    template <class S>
    static std::string written(const std::string& header, const Node* node, const std::string& path, S& spec)
    {
        StartWriter writer(node, path);
        describe(writer, spec);
        return header + writer.values_ + writer.others_ + writer.tables_;
    }

    template <class T>
    void operator()(const char* key, T& member, const Facts& f)
    {
        const Node* given = node_ ? node_->find(key) : nullptr;
        if (given) return add(values_, fmt::format("{} = {}", key, source_text(*given)), comment(f, false, false));
        if (!f.used.holds && !std::string_view(f.used.text).empty()) return;  // of another kind
        add(others_, fmt::format("#{} = {}", key, shown(member)), comment(f, true, f.required.holds));
    }
    template <class S>
    void table(const char* key, S& member, const Facts& f)
    {
        const std::string path = joined(path_, key);
        const Node* given = node_ ? node_->find(key) : nullptr;
        if (!given && !f.used.holds) {
            if (std::string_view(f.used.text).empty())
                tables_ += '\n' + wrapped(fmt::format("[{}]: {}; see docs/input.md", path, f.meaning));
            return;
        }
        tables_ +=
            written(fmt::format("\n{}{}[{}]\n", wrapped(f.meaning), given ? "" : "#", path), given, path, member);
    }
    template <class S>
    void array(const char* key, std::vector<S>& member, const Facts& f)
    {
        const std::string path = joined(path_, key);
        const Node* given = node_ ? node_->find(key) : nullptr;
        if (!given) {
            if (f.used.holds || std::string_view(f.used.text).empty())
                tables_ += '\n' + wrapped(fmt::format("[[{}]]: {}; see docs/input.md", path, f.meaning));
            return;
        }
        for (std::size_t i = 0; i < member.size(); ++i) {
            const std::string header = fmt::format("\n{}[[{}]]\n", i == 0 ? wrapped(f.meaning) : "", path);
            tables_ += written(header, &given->children[i], path, member[i]);
        }
    }
    template <class S>
    void named(const char* key, std::vector<S>& member, const Facts& f)
    {
        const Node* given = node_ ? node_->find(key) : nullptr;
        for (std::size_t i = 0; given && i < member.size(); ++i) {
            const std::string path = joined(joined(path_, key), member[i].name);
            tables_ += written(fmt::format("\n{}[{}]\n", i == 0 ? wrapped(f.meaning) : "", path), &given->children[i],
                               path, member[i]);
        }
    }

private:
    /// Values of a start stand on one line.
    static std::string source_text(const Node& node) { return node.place.text; }

    static void add(std::string& lines, const std::string& entry, const std::string& text)
    {
        if (text.empty())
            lines += entry + '\n';
        else if (entry.size() + text.size() + 4 <= line_width)
            lines += fmt::format("{}  # {}\n", entry, text);
        else
            lines += wrapped(text) + entry + '\n';
    }

    const Node* node_;
    std::string path_;
    std::string values_, others_, tables_;
};

}  // namespace

std::vector<std::string> new_case_kinds()
{
    std::vector<std::string> kinds;
    for (const InputStart& start : input_starts()) kinds.push_back(start.kind);
    return kinds;
}

std::string new_case(const std::string& kind)
{
    const auto& starts = input_starts();
    const auto start = std::find_if(starts.begin(), starts.end(), [&](const InputStart& s) { return s.kind == kind; });
    if (start == starts.end()) throw std::invalid_argument("no test is called " + kind);
    std::map<std::string, SourcePlace> places;
    const Node document = parse_document(start->text, "start", places);
    Case c = read_case_text(start->text, "start", {}, places);
    const std::string run = kind == "calibrate" ? "calibrate" : "run";
    const std::string head = wrapped(fmt::format("{}: {}.", kind, start->about)) +
                             fmt::format(
                                 "#   grainfrac check FILE    what will be simulated, and how long it takes\n"
                                 "#   grainfrac {} FILE\n"
                                 "# Keys behind a # show their defaults; docs/input.md tells all of them.\n\n",
                                 run);
    std::string text = StartWriter::written("", &document, "", c);
    return head + text.substr(text.find_first_not_of('\n'));
}

}  // namespace grainfrac
