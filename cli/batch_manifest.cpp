// SPDX-License-Identifier: GPL-3.0-or-later
#include "batch_manifest.h"

#include <algorithm>
#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <string_view>
#include <system_error>
#include <utility>
#include <vector>

#include "content_hash.h"
#include "droplet/error.h"
#include "droplet/version.h"
#include "files.h"
#include "option_values.h"

namespace cli {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

constexpr const char* kSchema = "droplet-shape.manifest/1";

Json jsonOf(const ManifestRow& row, const BatchItem& item)
{
    const bool has_failed = row.status == ItemStatus::Failed;
    Json json{{"index", row.index + 1},
              {"name", item.name},
              {"input", item.input.empty() ? Json() : Json(item.input)},
              {"output", item.output},
              {"status", name(row.status)},
              {"error", has_failed ? Json(row.error) : Json()},
              {"exit_code", row.status == ItemStatus::NotStarted ? Json() : Json(row.exit_code)}};
    if (row.file) {
        const BatchFigures& figures = row.file->figures;
        json.update(Json{{"fingerprint", row.file->fingerprint},
                         {"bytes", row.file->bytes},
                         {"sha256", row.file->sha256},
                         {"others", row.file->others},
                         {"triangles", figures.triangles},
                         {"vertices", figures.vertices},
                         {"closed", figures.closed},
                         {"volume_m3", figures.volume},
                         {"height_max_m", figures.height_max},
                         {"warnings", figures.warnings}});
    } else {
        for (const char* key : {"fingerprint", "bytes", "sha256", "others", "triangles", "vertices", "closed",
                                "volume_m3", "height_max_m", "warnings"}) {
            json[key] = nullptr;
        }
    }
    json["time_s"] = row.time;
    return json;
}

std::optional<MadeFile> fileIn(const Json& row)
{
    if (!row.at("fingerprint").is_string()) {
        return std::nullopt;
    }
    MadeFile file;
    row.at("fingerprint").get_to(file.fingerprint);
    row.at("bytes").get_to(file.bytes);
    row.at("sha256").get_to(file.sha256);
    row.at("others").get_to(file.others);
    row.at("triangles").get_to(file.figures.triangles);
    row.at("vertices").get_to(file.figures.vertices);
    row.at("closed").get_to(file.figures.closed);
    row.at("volume_m3").get_to(file.figures.volume);
    row.at("height_max_m").get_to(file.figures.height_max);
    row.at("warnings").get_to(file.figures.warnings);
    return file;
}

/// Whether the text between a manifest's stem and its extension is that of a shard, such as -2-of-8.
bool isShard(std::string_view text)
{
    const auto skip = [&](std::string_view word) {
        const bool found = text.substr(0, word.size()) == word;
        text.remove_prefix(found ? word.size() : 0);
        return found;
    };
    const auto skip_number = [&] {
        const auto digits = std::min(text.find_first_not_of("0123456789"), text.size());
        text.remove_prefix(digits);
        return digits > 0;
    };
    return skip("-") && skip_number() && skip("-of-") && skip_number() && text.empty();
}

/// Existing manifests: this one, and those of shards beside it.
std::vector<fs::path> manifestsOf(const fs::path& manifest)
{
    std::vector<fs::path> found;
    std::error_code failure;
    if (fs::is_regular_file(manifest, failure)) {  // a device may have no end
        found.push_back(manifest);
    }
    const std::string stem = manifest.stem().string();
    const std::string extension = manifest.extension().string();
    const fs::path folder = manifest.has_parent_path() ? manifest.parent_path() : fs::path(".");
    for (const fs::directory_entry& entry : fs::directory_iterator(folder, failure)) {
        const std::string name = entry.path().filename().string();
        if (name.size() > stem.size() + extension.size() && name.compare(0, stem.size(), stem) == 0 &&
            entry.path().extension() == extension && entry.is_regular_file(failure) &&
            isShard(std::string_view(name).substr(stem.size(), name.size() - stem.size() - extension.size()))) {
            found.push_back(entry.path());
        }
    }
    return found;
}

/// Text after writing to and reading from JSON, which replaces bytes that are not UTF-8.
std::string inJson(const std::string& text)
{
    return Json::parse(Json(text).dump(-1, ' ', false, Json::error_handler_t::replace)).get<std::string>();
}

}  // namespace

void writeManifest(const std::vector<ManifestRow>& rows, const std::vector<BatchItem>& items,
                   const BatchOptions& options, double seconds)
{
    Json decisive = Json::object();
    for (const auto& [key, value] : options.decisive) {
        decisive[key] = value;
    }
    Json item_rows = Json::array();
    std::map<ItemStatus, std::size_t> counts;
    std::uint64_t bytes = 0;
    std::size_t triangles = 0;
    for (const ManifestRow& row : rows) {
        item_rows.push_back(jsonOf(row, items[row.index]));
        ++counts[row.status];
        if (row.file && row.status != ItemStatus::NotStarted) {
            bytes += row.file->bytes;
            triangles += row.file->figures.triangles;
        }
    }
    Json left_out = Json::array();
    for (const auto& [what, reason] : options.left_out) {
        left_out.push_back({{"name", what}, {"reason", reason}});
    }
    const auto& shard = options.shard;
    const Json manifest{{"schema", kSchema},
                        {"version", droplet::kVersion},
                        {"options", decisive},
                        {"shard", shard ? Json{{"index", shard->index}, {"count", shard->count}} : Json()},
                        {"items", item_rows},
                        {"left_out", left_out},
                        {"totals",
                         {{"items", rows.size()},
                          {"made", counts[ItemStatus::Made]},
                          {"skipped", counts[ItemStatus::Skipped]},
                          {"failed", counts[ItemStatus::Failed]},
                          {"not_started", counts[ItemStatus::NotStarted]},
                          {"bytes", bytes},
                          {"triangles", triangles},
                          {"time_s", seconds}}}};
    droplet::writeAtomically(options.manifest, [&](std::ostream& out) {
        out << manifest.dump(1, ' ', false, Json::error_handler_t::replace) << "\n";
    });
}

EarlierRun::EarlierRun(const std::string& manifest)
{
    // Later manifests override earlier ones.
    std::vector<std::pair<fs::file_time_type, fs::path>> found;
    std::error_code failure;
    for (const fs::path& path : manifestsOf(manifest)) {
        found.emplace_back(fs::last_write_time(path, failure), path);
    }
    std::sort(found.begin(), found.end());
    for (const auto& [time, path] : found) {
        read(path.string(), path == fs::path(manifest));
    }
}

void EarlierRun::read(const std::string& manifest, bool is_replaced)
{
    const std::string text = textOf(manifest);
    if (text.empty()) {
        return;
    }
    try {
        const Json json = Json::parse(text);
        if (json.at("schema") != kSchema) {
            throw std::invalid_argument("another schema");
        }
        for (const Json& row : json.at("items")) {
            if (auto file = fileIn(row)) {
                files_.insert_or_assign(row.at("output").get<std::string>(), std::move(*file));
            }
        }
    } catch (const std::exception&) {
        if (is_replaced) {
            refuse("--manifest: " + manifest + " exists and is not a " + kSchema +
                   "; give another path, or remove the file");
        }
    }
}

std::optional<MadeFile> EarlierRun::at(const BatchItem& item) const
{
    const auto found = files_.find(inJson(item.output));
    return found == files_.end() ? std::nullopt : std::optional(found->second);
}

bool isUpToDate(const BatchItem& item, const std::string& fingerprint, const std::optional<MadeFile>& earlier)
{
    std::error_code failure;
    if (!earlier || earlier->fingerprint != fingerprint || !fs::is_regular_file(item.output, failure) ||
        fs::file_size(item.output, failure) != earlier->bytes || failure) {
        return false;
    }
    for (const std::string& other : item.others) {
        const bool was_made =
            std::find(earlier->others.begin(), earlier->others.end(), inJson(other)) != earlier->others.end();
        if (!was_made || !fs::exists(other, failure)) {
            return false;
        }
    }
    try {
        return hashOfFile(item.output) == earlier->sha256;
    } catch (const droplet::Error&) {
        return false;  // making the item again will report the cause
    }
}

}  // namespace cli
