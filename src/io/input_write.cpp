// SPDX-License-Identifier: GPL-3.0-or-later
// The two other readers of the key descriptions: resolved.toml and the tables of docs/input.md.
#include "io/input.h"
#include "io/input_document.h"
#include "io/input_schema.h"
#include "io/toml_text.h"

#include <fmt/format.h>

#include <string_view>

namespace grainfrac {
namespace {

std::string_view unit_of(const Facts& facts)
{
    return std::string_view(facts.unit) == "1" ? std::string_view() : facts.unit;
}

/// Writes a struct as a TOML table: its values first, then the tables below it.
class TomlWriter {
public:
    explicit TomlWriter(std::string path) : path_(std::move(path)) {}

    template <class S>
    static std::string written(const std::string& header, const std::string& path, S& spec)
    {
        TomlWriter writer(path);
        describe(writer, spec);
        return header + writer.values_ + writer.tables_;
    }

    template <class T>
    void operator()(const char* key, T& member, const Facts& facts)
    {
        if (!facts.used.holds) return;
        const std::string_view unit = unit_of(facts);
        values_ += fmt::format("{} = {}{}{}\n", key, toml_text(member), unit.empty() ? "" : "  # ", unit);
    }
    template <class S>
    void table(const char* key, S& member, const Facts& facts)
    {
        const std::string path = joined(path_, key);
        if (facts.used.holds) tables_ += written(fmt::format("\n[{}]\n", path), path, member);
    }
    template <class S>
    void array(const char* key, std::vector<S>& member, const Facts&)
    {
        const std::string path = joined(path_, key);
        for (S& entry : member) tables_ += written(fmt::format("\n[[{}]]\n", path), path, entry);
    }
    template <class S>
    void named(const char* key, std::vector<S>& member, const Facts&)
    {
        for (S& entry : member) {
            const std::string path = joined(joined(path_, key), entry.name);
            tables_ += written(fmt::format("\n[{}]\n", path), path, entry);
        }
    }

private:
    std::string path_;
    std::string values_, tables_;
};

std::string in_cell(const std::string& text)
{
    std::string out;
    for (const char c : text) out += c == '|' ? std::string("\\|") : std::string(1, c);
    return out;
}

/// Type of a member for the tables: its unit, or what else it is.
std::string kind(const double&, const Facts& f)
{
    return unit_of(f).empty() ? "number" : f.unit;
}
std::string kind(const std::optional<double>&, const Facts& f)
{
    return kind(double{}, f);
}
std::string kind(const int&, const Facts&)
{
    return "integer";
}
std::string kind(const std::int64_t&, const Facts&)
{
    return "integer";
}
std::string kind(const std::optional<std::int64_t>&, const Facts&)
{
    return "integer";
}
std::string kind(const bool&, const Facts&)
{
    return "true, false";
}
std::string kind(const std::string& s, const Facts& f)
{
    static_cast<void>(s);
    return std::string_view(f.words).empty() ? "text" : "word";
}
std::string kind(const Vec3&, const Facts& f)
{
    return "3 × " + kind(double{}, f);
}
std::string kind(const std::optional<Vec3>&, const Facts& f)
{
    return kind(Vec3{}, f);
}
std::string kind(const std::vector<double>&, const Facts& f)
{
    return kind(double{}, f) + ", or a list";
}
std::string kind(const std::vector<std::string>& v, const Facts& f)
{
    static_cast<void>(v);
    return std::string_view(f.words).empty() ? "list of texts" : "list of words";
}
std::string kind(const std::vector<Vec3>&, const Facts& f)
{
    return "list of " + kind(Vec3{}, f);
}
std::string kind(const std::array<std::string, 2>&, const Facts&)
{
    return "2 names";
}

std::string allowed(const Facts& f)
{
    std::string out;
    for (const Word& word : words_of(f)) {
        out += (out.empty() ? "`" : ", `") + word.typed + '`';
        if (word.typed != word.meant) out += " (" + word.meant + ')';
    }
    return out.empty() ? range_text(f) : out;
}

/// Default of a key: of the struct, what "auto" means, or that the key is required.
template <class T>
std::string default_text(const T& member, const Facts&)
{
    return '`' + toml_text(member) + '`';
}
template <class T>
std::string default_text(const std::optional<T>&, const Facts& f)
{
    return std::string("`\"auto\"`: ") + f.unset;
}
std::string default_text(const std::string& member, const Facts&)
{
    return member.empty() ? "none" : '`' + toml_text(member) + '`';
}
template <class T>
std::string default_text(const std::vector<T>& member, const Facts&)
{
    return member.empty() ? "none" : '`' + toml_text(member) + '`';
}

bool ever_required(const Facts& f)
{
    return f.required.holds || !std::string_view(f.required.text).empty();
}

std::string required_text(const Facts& f)
{
    const std::string_view with = f.required.text;
    return with.empty() ? "required" : fmt::format("required with `{}`", with);
}

std::string capitalised(std::string s)
{
    if (!s.empty() && s[0] >= 'a' && s[0] <= 'z') s[0] = static_cast<char>(s[0] - 'a' + 'A');
    return s;
}

/// Writes a section with a table of keys for each struct.
class MarkdownWriter {
public:
    explicit MarkdownWriter(std::string path) : path_(std::move(path)) {}

    template <class S>
    static std::string written(const std::string& title, const std::string& path, const Facts& facts)
    {
        MarkdownWriter writer(path);
        S spec;
        describe(writer, spec);
        std::string out;
        if (!title.empty()) out = fmt::format("### `{}`\n\n{}.", title, capitalised(facts.meaning));
        if (!title.empty() && ever_required(facts)) out += fmt::format(" Required{}.", required_text(facts).substr(8));
        if (!title.empty()) out += "\n\n";
        if (!writer.rows_.empty()) {
            out += "| key | meaning | type, SI unit | default | allowed | source |\n|---|---|---|---|---|---|\n" +
                   writer.rows_ + '\n';
        }
        return out + writer.sections_;
    }

    template <class T>
    void operator()(const char* key, T& member, const Facts& f)
    {
        const std::string_view with = f.used.text;
        const std::string meaning =
            with.empty() ? std::string(f.meaning) : fmt::format("{} (with `{}`)", f.meaning, with);
        const std::string standard = ever_required(f) ? required_text(f) : default_text(member, f);
        rows_ += fmt::format("| `{}` | {} | {} | {} | {} | {} |\n", key, in_cell(meaning), kind(member, f),
                             in_cell(standard), in_cell(allowed(f)), in_cell(f.source));
    }
    template <class S>
    void table(const char* key, S&, const Facts& facts)
    {
        const std::string path = joined(path_, key);
        sections_ += written<S>('[' + path + ']', path, facts);
    }
    template <class S>
    void array(const char* key, std::vector<S>&, const Facts& facts)
    {
        const std::string path = joined(path_, key);
        sections_ += written<S>("[[" + path + "]]", path, facts);
    }
    template <class S>
    void named(const char* key, std::vector<S>&, const Facts& facts)
    {
        const std::string path = joined(path_, key) + ".NAME";
        sections_ += written<S>('[' + path + ']', path, facts);
    }

private:
    std::string path_;
    std::string rows_, sections_;
};

}  // namespace

std::string to_toml(const Case& c)
{
    Case copy = c;
    return TomlWriter::written("# The input with every default, in SI units.\n", "", copy);
}

std::string bonds_to_toml(const BondSpec& bond)
{
    BondSpec copy = bond;
    return TomlWriter::written("[[bonds]]\n", "bonds", copy);
}

std::string input_reference_markdown()
{
    return MarkdownWriter::written<Case>("", "", {});
}

}  // namespace grainfrac
