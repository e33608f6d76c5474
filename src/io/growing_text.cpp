// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/growing_text.h"

#include "io/atomic_file.h"
#include "model/checksum.h"

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <stdexcept>
#include <utility>
#include <vector>

namespace grainfrac {

namespace {

/// Checksum of the first bytes of a file; throws if there are less.
std::uint64_t checksum_of_head(const std::filesystem::path& path, std::int64_t bytes)
{
    std::ifstream in(path, std::ios::binary);
    if (!in) throw std::runtime_error(path.string() + ": cannot read: " + std::strerror(errno));
    std::vector<char> block(1 << 20);
    std::uint64_t sum = no_bytes_checksum;
    while (bytes > 0) {
        const auto want = std::min(bytes, static_cast<std::int64_t>(block.size()));
        if (!in.read(block.data(), want))
            throw std::runtime_error(path.string() + ": is shorter than at the checkpoint");
        sum = checksum(block.data(), static_cast<std::size_t>(want), sum);
        bytes -= want;
    }
    return sum;
}

}  // namespace

void check_head(const std::filesystem::path& path, const TextMark& mark)
{
    if (checksum_of_head(path, mark.bytes) != mark.checksum)
        throw std::runtime_error(path.string() + ": was altered since the checkpoint");
}

GrowingText::GrowingText(std::filesystem::path path, const std::string& head)
    : path_(std::move(path)), file_(path_, std::ios::binary | std::ios::trunc), written_{0, no_bytes_checksum}
{
    append(head);
}

GrowingText::GrowingText(std::filesystem::path path, const TextMark& mark) : path_(std::move(path)), written_(mark)
{
    check_head(path_, mark);
    std::error_code error;
    std::filesystem::resize_file(path_, static_cast<std::uintmax_t>(mark.bytes), error);
    if (error) throw std::runtime_error(path_.string() + ": cannot write: " + error.message());
    file_.open(path_, std::ios::binary | std::ios::app);
    append("");
}

void GrowingText::append(const std::string& text)
{
    errno = 0;
    if (!(file_ << text << std::flush))
        throw std::runtime_error(path_.string() + ": cannot write: " + std::strerror(errno != 0 ? errno : EIO));
    written_.bytes += static_cast<std::int64_t>(text.size());
    written_.checksum = checksum(text.data(), text.size(), written_.checksum);
}

TextMark GrowingText::mark() const
{
    sync_file(path_);
    return written_;
}

void GrowingText::close()
{
    if (!file_.is_open()) return;
    file_.close();
    if (!file_) throw std::runtime_error(path_.string() + ": cannot close: " + std::strerror(errno));
}

}  // namespace grainfrac
