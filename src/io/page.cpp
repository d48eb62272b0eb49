// SPDX-License-Identifier: GPL-3.0-or-later
// WHATWG, "HTML Living Standard", sections 13.1.2 (the end of raw text and title elements) and 4.12.1.3 (script
// elements that hold data).
#include "droplet/io/page.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <nlohmann/json.hpp>
#include <ostream>
#include <string>
#include <string_view>

#include "byte_stream.h"
#include "droplet/error.h"
#include "droplet/io/base64.h"
#include "io/page_parts.h"
#include "xml_text.h"

namespace droplet {
namespace {

using Json = nlohmann::ordered_json;

// Browsers hold its base64 in one string; strings are limited to about 512 MiB.
constexpr std::size_t kLargestModel = std::size_t{256} << 20;

// Report keys that differ between runs of the same job.
constexpr std::array kNotOfTheDroplet = {"time_s", "peak_memory_bytes"};

[[noreturn]] void refuse(const std::string& what)
{
    throw Error(ErrorCode::InvalidArgument, "page: " + what);
}

void check(const std::string& glb)
{
    if (glb.substr(0, 4) != "glTF") {
        refuse("content.glb must be a GLB file, which begins with 'glTF'");
    }
    if (glb.size() > kLargestModel) {
        refuse("content.glb has " + std::to_string(glb.size()) + " bytes, must have at most " +
               std::to_string(kLargestModel));
    }
}

Json parsed(const std::string& report)
{
    Json json = Json::parse(report, nullptr, false);
    if (!json.is_object()) {
        refuse("content.report must be a JSON object");
    }
    for (const char* name : kNotOfTheDroplet) {
        json.erase(name);
    }
    return json;
}

std::string dump(const Json& json)
{
    return json.dump(-1, ' ', false, Json::error_handler_t::replace);
}

/// Escapes JSON for a script element. The escaped characters occur only in strings, where escapes mean the same.
std::string forScript(const std::string& json)
{
    std::string safe;
    for (const char c : json) {
        switch (c) {
            case '<':
                safe += "\\u003c";
                break;
            case '>':
                safe += "\\u003e";
                break;
            case '&':
                safe += "\\u0026";
                break;
            default:
                safe += c;
        }
    }
    return safe;
}

/// Escapes text for a title element; control characters, which have no meaning there, are dropped.
std::string forTitle(const std::string& text)
{
    std::string safe = xmlText(text, "&<");
    std::replace_if(
        safe.begin(), safe.end(), [](char c) { return static_cast<unsigned char>(c) < ' ' || c == '\x7f'; }, ' ');
    return safe;
}

}  // namespace

bool hasPage() noexcept
{
    return !kPageParts[0].empty();
}

std::uint64_t writePage(std::ostream& out, const PageContent& content)
{
    if (!hasPage()) {
        refuse("this build has no page; build it with -DDROPLET_PAGE=ON");
    }
    check(content.glb);
    Json data;
    data["title"] = content.title;
    data["report"] = parsed(content.report);
    // JSON replaces bytes that are not UTF-8.
    const std::string title = Json::parse(dump(content.title)).get<std::string>();

    ByteStream page(out);
    page.text(kPageParts[0]);
    page.text(forTitle(title));
    page.text(kPageParts[1]);
    page.text(forScript(dump(data)));
    page.text(kPageParts[2]);
    constexpr std::size_t kPart = std::size_t{3} << 16;
    for (std::size_t at = 0; at < content.glb.size(); at += kPart) {
        page.text(base64(std::string_view(content.glb).substr(at, kPart)));
    }
    page.text(kPageParts[3]);
    return page.finish();
}

}  // namespace droplet
