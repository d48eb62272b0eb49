// SPDX-License-Identifier: GPL-3.0-or-later
#include "droplet/wind_io/read_drive_cycle.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "csv_table.h"
#include "number_text.h"

namespace droplet {
namespace {

/// Number of rows from which equal intervals count as sampling, in which a row can be missing.
constexpr std::size_t kMinSampledRows = 10;

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

/// The column with a known heading.
std::optional<Column> columnOf(const CsvTable& table, const std::vector<std::pair<std::string, double>>& known)
{
    const auto unit_of = [&](const std::string& heading) -> std::optional<double> {
        for (const auto& [name, unit] : known) {
            if (normalised(heading) == name) {
                return unit;
            }
        }
        return std::nullopt;
    };
    const auto index = table.columnWhere([&](const std::string& heading) { return unit_of(heading).has_value(); });
    return index ? std::optional(Column{*index, *unit_of(table.header()->fields[*index])}) : std::nullopt;
}

/// Reads the rows of one file; errors name the row.
class Reader {
public:
    Reader(std::string_view text, const std::string& name) : table_(text, name, kGap) {}

    [[nodiscard]] DriveCycle read() const
    {
        if (!table_.header() || table_.rows().empty()) {
            // Wrong headings are reported first.
            if (table_.header()) {
                (void)columns();
            }
            table_.refuse("a drive cycle needs a header and at least one row");
        }
        const auto [time, speed] = columns();
        DriveCycle cycle{{}, {}};
        for (const CsvTable::Row& row : table_.rows()) {
            const double at = table_.number(row, time.index, "time") * time.unit;
            const double fast = table_.number(row, speed.index, "speed") * speed.unit;
            if (!cycle.times.empty() && at <= cycle.times.back()) {
                table_.refuse(row.number,
                              "time " + numberText(at) + " s must be after " + numberText(cycle.times.back()) + " s");
            }
            if (fast < 0.0) {
                table_.refuse(row.number, "speed is " + numberText(fast) + " m/s; it must be at least 0");
            }
            cycle.times.push_back(at);
            cycle.speeds.push_back(fast);
        }
        refuseGaps(cycle.times);
        return cycle;
    }

private:
    static constexpr std::string_view kGap = "the drive cycle has a gap";

    /// Columns of time and speed.
    [[nodiscard]] std::pair<Column, Column> columns() const
    {
        const double mph = 1609.344 / 3600.0;
        const auto time = columnOf(table_, {{"times", 1.0}, {"timems", 1e-3}, {"timemin", 60.0}, {"timeh", 3600.0}});
        const auto speed = columnOf(table_, {{"speedms", 1.0}, {"speedkmh", 1.0 / 3.6}, {"speedmph", mph}});
        if (!time || !speed) {
            table_.refuse(table_.header()->number,
                          "needs the headings time_s and speed_m_per_s, speed_km_per_h or speed_mph");
        }
        return {*time, *speed};
    }

    void refuseGaps(const std::vector<double>& times) const
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
                table_.refuse(table_.rows()[i + 1].number, "is " + numberText(intervals[i]) +
                                                               " s after the previous row, but there is a row every " +
                                                               numberText(usual) + " s: the drive cycle has a gap");
            }
        }
    }

    CsvTable table_;
};

}  // namespace

DriveCycle parseDriveCycle(std::string_view text, const std::string& name)
{
    return Reader(text, name).read();
}

DriveCycle readDriveCycle(const std::filesystem::path& path)
{
    return parseDriveCycle(readTable(path), path.string());
}

}  // namespace droplet
