// SPDX-License-Identifier: GPL-3.0-or-later
#include "droplet/wind_io/read_drive_cycle.h"

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>
#include <cstddef>
#include <optional>
#include <utility>

#include "droplet/error.h"
#include "file_bytes.h"
#include "number_text.h"

namespace droplet {
namespace {

constexpr std::size_t kMaxBytes = std::size_t{1} << 28U;  // years at 10 Hz

/// Number of rows from which equal intervals count as sampling, in which a row can be missing.
constexpr std::size_t kMinSampledRows = 10;

using Fields = std::vector<std::string>;

std::string trimmed(std::string_view text)
{
    const auto is_space = [](char c) { return c == ' ' || c == '\t'; };
    while (!text.empty() && is_space(text.front())) {
        text.remove_prefix(1);
    }
    while (!text.empty() && is_space(text.back())) {
        text.remove_suffix(1);
    }
    return std::string(text);
}

/// Fields of a line without their quotes (RFC 4180, except line breaks within quotes).
Fields fieldsOf(std::string_view line)
{
    Fields fields(1);
    bool quoted = false;
    for (std::size_t i = 0; i < line.size(); ++i) {
        const char c = line[i];
        if (c == '"' && quoted && i + 1 < line.size() && line[i + 1] == '"') {
            fields.back() += '"';
            ++i;
        } else if (c == '"') {
            quoted = !quoted;
        } else if (c == ',' && !quoted) {
            fields.emplace_back();
        } else {
            fields.back() += c;
        }
    }
    for (std::string& field : fields) {
        field = trimmed(field);
    }
    return fields;
}

/// Normalises a heading: `Speed (km/h)` and `speed_km_per_h` are both `speedkmh`.
std::string normalised(const std::string& heading)
{
    std::string letters;
    for (const char c : heading) {
        if (std::isalnum(static_cast<unsigned char>(c)) != 0) {
            letters += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
        }
    }
    if (const std::size_t per = letters.find("per"); per != std::string::npos) {
        letters.erase(per, 3);
    }
    return letters;
}

struct Column {
    std::size_t index = 0;
    double unit = 1.0;
};

/// First column with a known heading.
std::optional<Column> columnOf(const Fields& header, const std::vector<std::pair<std::string, double>>& known)
{
    for (std::size_t c = 0; c < header.size(); ++c) {
        for (const auto& [heading, unit] : known) {
            if (normalised(header[c]) == heading) {
                return Column{c, unit};
            }
        }
    }
    return std::nullopt;
}

/// Reads the rows of one file; errors name the row.
class Reader {
public:
    explicit Reader(std::string name) : name_(std::move(name)) {}

    [[nodiscard]] DriveCycle read(std::string_view text) const
    {
        if (text.substr(0, 3) == "\xEF\xBB\xBF") {
            text.remove_prefix(3);
        }
        DriveCycle cycle{{}, {}};
        std::vector<std::size_t> rows;
        std::optional<Column> time;
        std::optional<Column> speed;
        std::size_t empty = 0;  // first empty line since the last row
        std::size_t headings = 0;
        for (std::size_t row = 1; !text.empty(); ++row) {
            const std::size_t end = text.find('\n');
            std::string_view line = text.substr(0, end);
            text.remove_prefix(end == std::string_view::npos ? text.size() : end + 1);
            if (!line.empty() && line.back() == '\r') {
                line.remove_suffix(1);
            }
            if (trimmed(line).empty()) {
                empty = empty == 0 ? row : empty;
                continue;
            }
            const Fields fields = fieldsOf(line);
            if (!time) {
                const double mph = 1609.344 / 3600.0;
                time = columnOf(fields, {{"times", 1.0}, {"timems", 1e-3}, {"timemin", 60.0}, {"timeh", 3600.0}});
                speed = columnOf(fields, {{"speedms", 1.0}, {"speedkmh", 1.0 / 3.6}, {"speedmph", mph}});
                if (!time || !speed) {
                    refuse(row, "needs the headings time_s and speed_m_per_s, speed_km_per_h or speed_mph");
                }
                empty = 0;
                headings = fields.size();
                continue;
            }
            if (fields.size() > headings) {
                refuse(row, "has " + std::to_string(fields.size()) + " cells, the header has " +
                                std::to_string(headings) +
                                ": write decimals with a point, and quote fields that contain a comma");
            }
            if (empty != 0) {
                refuse(empty, "is empty: the drive cycle has a gap");
            }
            const double at = numberOf(fields, time->index, "time", row) * time->unit;
            const double fast = numberOf(fields, speed->index, "speed", row) * speed->unit;
            if (!cycle.times.empty() && at <= cycle.times.back()) {
                refuse(row, "time " + numberText(at) + " s must be after " + numberText(cycle.times.back()) + " s");
            }
            if (fast < 0.0) {
                refuse(row, "speed is " + numberText(fast) + " m/s; it must be at least 0");
            }
            cycle.times.push_back(at);
            cycle.speeds.push_back(fast);
            rows.push_back(row);
        }
        if (cycle.times.empty()) {
            throw Error(ErrorCode::InvalidInput, name_ + ": a drive cycle needs a header and at least one row");
        }
        refuseGaps(cycle.times, rows);
        return cycle;
    }

private:
    [[noreturn]] void refuse(std::size_t row, const std::string& what) const
    {
        throw Error(ErrorCode::InvalidInput, name_ + ": row " + std::to_string(row) + ": " + what);
    }

    [[nodiscard]] double numberOf(const Fields& fields, std::size_t column, const char* what, std::size_t row) const
    {
        if (column >= fields.size() || fields[column].empty()) {
            refuse(row, std::string("has no ") + what + ": the drive cycle has a gap");
        }
        const std::string& field = fields[column];
        double value = 0.0;
        const char* end = field.data() + field.size();
        const auto [stop, error] = std::from_chars(field.data() + (field[0] == '+' ? 1 : 0), end, value);
        if (error != std::errc() || stop != end || !std::isfinite(value)) {
            refuse(row, std::string(what) + " is '" + field.substr(0, 40) + "'; it must be a finite number");
        }
        return value;
    }

    void refuseGaps(const std::vector<double>& times, const std::vector<std::size_t>& rows) const
    {
        if (times.size() < kMinSampledRows) {
            return;
        }
        std::vector<double> intervals;
        for (std::size_t i = 1; i < times.size(); ++i) {
            intervals.push_back(times[i] - times[i - 1]);
        }
        std::vector<double> sorted = intervals;
        const auto middle = sorted.begin() + static_cast<std::ptrdiff_t>(sorted.size() / 2);
        std::nth_element(sorted.begin(), middle, sorted.end());
        const double usual = *middle;
        const auto is_usual = [usual](double d) { return std::abs(d - usual) <= 0.01 * usual; };
        if (2 * std::count_if(intervals.begin(), intervals.end(), is_usual) <
            static_cast<std::ptrdiff_t>(intervals.size())) {
            return;
        }
        for (std::size_t i = 0; i < intervals.size(); ++i) {
            if (intervals[i] >= 1.5 * usual) {
                refuse(rows[i + 1], "is " + numberText(intervals[i]) +
                                        " s after the previous row, but there is a row every " + numberText(usual) +
                                        " s: the drive cycle has a gap");
            }
        }
    }

    std::string name_;
};

}  // namespace

DriveCycle parseDriveCycle(std::string_view text, const std::string& name)
{
    return Reader(name).read(text);
}

DriveCycle readDriveCycle(const std::filesystem::path& path)
{
    Bytes bytes;
    readFile(path, [&] { bytes = readBytes(path, kMaxBytes, [](std::byte) { return true; }); });
    return parseDriveCycle({reinterpret_cast<const char*>(bytes.data()), bytes.size()}, path.string());
}

}  // namespace droplet
