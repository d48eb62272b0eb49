// SPDX-License-Identifier: GPL-3.0-or-later
#include "droplet/io/output.h"

#include <cstddef>
#include <ostream>
#include <streambuf>
#include <string>
#include <vector>

#include "droplet/error.h"
#include "droplet/printable.h"
#include "io/draft.h"

namespace droplet {
namespace {

constexpr std::size_t kBufferBytes = std::size_t{1} << 16;

/// Stream buffer of a draft. std::filebuf would not remember why it failed.
class DraftBuffer : public std::streambuf {
public:
    explicit DraftBuffer(Draft& draft) : draft_(draft) { clear(); }

    [[nodiscard]] std::uint64_t written() const { return written_; }

protected:
    int_type overflow(int_type c) override
    {
        if (sync() != 0) {
            return traits_type::eof();
        }
        if (!traits_type::eq_int_type(c, traits_type::eof())) {
            sputc(traits_type::to_char_type(c));
        }
        return traits_type::not_eof(c);
    }

    int sync() override
    {
        const bool ok = put(pbase(), static_cast<std::size_t>(pptr() - pbase()));
        clear();
        return ok ? 0 : -1;
    }

    std::streamsize xsputn(const char* bytes, std::streamsize count) override
    {
        if (count < epptr() - pptr()) {
            return std::streambuf::xsputn(bytes, count);
        }
        return sync() == 0 && put(bytes, static_cast<std::size_t>(count)) ? count : 0;
    }

private:
    void clear() { setp(buffer_.data(), buffer_.data() + buffer_.size()); }

    bool put(const char* bytes, std::size_t count)
    {
        written_ += count;
        return draft_.write(bytes, count);
    }

    Draft& draft_;
    std::uint64_t written_ = 0;
    // Not on the stack: files that appear together are written inside one another, hundreds of a turntable.
    std::vector<char> buffer_ = std::vector<char>(kBufferBytes);
};

}  // namespace

void throwOutputFailed(const std::filesystem::path& path, const std::string& cause)
{
    throw Error(ErrorCode::OutputFailed, "output \"" + printable(path.string()) + "\": " + cause);
}

void throwMustNotBeReplaced(const std::filesystem::path& path)
{
    throwOutputFailed(path, "exists and must not be replaced");
}

std::uint64_t writeAtomically(const std::filesystem::path& path, const std::function<void(std::ostream&)>& write,
                              const OutputOptions& options)
{
    Draft draft(path, options);
    DraftBuffer buffer(draft);
    std::ostream out(&buffer);
    write(out);
    out.flush();
    if (const std::string problem = draft.problem(); !problem.empty()) {
        throwOutputFailed(path, problem);
    }
    if (!out) {
        throwOutputFailed(path, "the stream failed before all data was written");
    }
    draft.commit();
    return buffer.written();
}

}  // namespace droplet
