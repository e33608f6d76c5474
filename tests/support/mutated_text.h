// SPDX-License-Identifier: GPL-3.0-or-later
// Wrong input files, made from good ones: the same for the same number.
#pragma once

#include <array>
#include <cstdint>
#include <random>
#include <string>
#include <vector>

namespace grainfrac::test {

class Mutation {
public:
    explicit Mutation(std::uint64_t number) : random_(number) {}

    /// One to three changes.
    std::string operator()(std::string text)
    {
        static const std::array<std::size_t, 6> changes{1, 1, 1, 1, 2, 3};
        for (std::size_t k = one_of(changes); k > 0; --k) text = changed(std::move(text));
        return text;
    }

private:
    std::size_t pick(std::size_t n) { return n > 0 ? random_() % n : 0; }
    template <class T, std::size_t n>
    const T& one_of(const std::array<T, n>& all)
    {
        return all[pick(n)];
    }

    std::string changed(std::string text)
    {
        switch (pick(15)) {
            case 0:
                return with_line(text, [&](std::string&) { return 0; });  // deleted
            case 1:
                return with_line(text, [&](std::string&) { return 2; });  // doubled
            case 2:
                return with_line(text, [&](std::string& line) { return misspelt(line), 1; });
            case 3:
            case 4:
            case 5:
                return with_line(text, [&](std::string& line) { return other_value(line), 1; });
            case 6:
                return with_line(text, [&](std::string& line) { return other_unit(line), 1; });
            case 7:
            case 8:
            case 9:
            case 10:
            case 11:
            case 12:
            case 13:
                return with_line(text, [&](std::string& line) { return other_size(line), 1; });
            default:
                return noise(std::move(text));
        }
    }

    /// One line of the text that is not empty and no comment; how often it stands there afterwards.
    template <class Change>
    std::string with_line(const std::string& text, const Change& change)
    {
        std::vector<std::string> lines;
        std::vector<std::size_t> told;
        for (std::size_t i = 0; i < text.size();) {
            const std::size_t end = std::min(text.find('\n', i), text.size());
            lines.push_back(text.substr(i, end - i));
            if (!lines.back().empty() && lines.back()[0] != '#') told.push_back(lines.size() - 1);
            i = end + 1;
        }
        if (told.empty()) return text;
        const std::size_t at = told[pick(told.size())];
        const int times = change(lines[at]);
        std::string out;
        for (std::size_t k = 0; k < lines.size(); ++k) {
            for (int t = k == at ? times : 1; t > 0; --t) out += lines[k] + '\n';
        }
        return out;
    }

    void misspelt(std::string& line)
    {
        const std::size_t at = pick(line.size());
        switch (pick(3)) {
            case 0:
                line.erase(at, 1);
                break;
            case 1:
                line.insert(at, 1, static_cast<char>('a' + pick(26)));
                break;
            default:
                if (at + 1 < line.size()) std::swap(line[at], line[at + 1]);
        }
    }

    void other_value(std::string& line)
    {
        static const std::array<std::string, 37> values{"0",
                                                        "-1",
                                                        "1",
                                                        "2.5",
                                                        "1e308",
                                                        "-1e308",
                                                        "1e-320",
                                                        "nan",
                                                        "inf",
                                                        "-inf",
                                                        "true",
                                                        "\"\"",
                                                        "\"text\"",
                                                        "[]",
                                                        "{}",
                                                        "[1, 2]",
                                                        "[1, 2, 3]",
                                                        "[[1, 2, 3], [4, 5, 6]]",
                                                        "{ a = 1 }",
                                                        "9223372036854775807",
                                                        "-9223372036854775808",
                                                        "\"auto\"",
                                                        "\"1 m\"",
                                                        "\"1 kg\"",
                                                        "\"-5 GPa\"",
                                                        "\"1e400 m\"",
                                                        "\"1 m^0.5\"",
                                                        "\"1 /\"",
                                                        "1979-05-27",
                                                        "\"*\"",
                                                        "\"../../../etc/passwd\"",
                                                        "\"/dev/zero\"",
                                                        "\"/\"",
                                                        "\"1 nm\"",
                                                        "\"1 km\"",
                                                        "\"90 deg\"",
                                                        "[\"x\"]"};
        const std::size_t equal = line.find('=');
        if (equal == line.npos) return misspelt(line);
        line = line.substr(0, equal + 1) + ' ' + one_of(values);
    }

    void other_unit(std::string& line)
    {
        static const std::array<std::string, 16> units{"m",   "mm",     "um",     "km",    "Pa",   "MPa",
                                                       "GPa", "kg/m^3", "g/cm^3", "J/m^2", "mm/s", "Pa/m",
                                                       "s",   "deg/s",  "degC",   "m^-1"};
        const std::size_t from = line.find(' ', line.find('"')), to = line.find('"', from);
        if (from == line.npos || to == line.npos) return other_value(line);
        line.replace(from + 1, to - from - 1, one_of(units));
    }

    /// A number times a power of ten.
    void other_size(std::string& line)
    {
        const std::size_t digit = line.find_first_of("123456789", line.find('='));
        if (line.find('=') == line.npos || digit == line.npos) return other_value(line);
        const std::size_t end = std::min(line.find_first_not_of("0123456789.", digit), line.size());
        static const std::array<int, 14> powers{-30, -6, -3, -2, -2, -1, -1, -1, 1, 1, 2, 3, 6, 30};
        line.insert(end, "e" + std::to_string(one_of(powers)));
    }

    std::string noise(std::string text)
    {
        if (text.empty()) return text;
        const std::size_t at = pick(text.size()), length = 1 + pick(40);
        switch (pick(5)) {
            case 0:
                text.resize(at);
                break;
            case 1:
                text.erase(at, length);
                break;
            case 2:
                for (std::size_t k = at; k < std::min(at + length, text.size()); ++k)
                    text[k] = static_cast<char>(random_());
                break;
            case 3:
                text.insert(at, text.substr(pick(text.size()), length));
                break;
            default:
                for (std::size_t k = 0; k < length; ++k) text.insert(at, 1, "[]{}\"'=#.\\\0\xff"[pick(12)]);
        }
        return text;
    }

    std::mt19937_64 random_;
};

}  // namespace grainfrac::test
