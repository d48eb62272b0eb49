// SPDX-License-Identifier: GPL-3.0-or-later
// Content of a page; page/browser_test.cpp tests its behaviour.
#include "droplet/io/page.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstddef>
#include <cstdint>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>

#include "droplet/error.h"
#include "droplet/io/report.h"
#include "support/base64.h"

namespace droplet {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;
using ::testing::StartsWith;

// Text that ends elements, scripts and strings, or begins comments and escapes.
const std::string kHostile =
    "</script><script>alert(1)</script> </title> <!-- <script> --> ]]> \"'`\\u003c/script\\u003e &lt;/title&gt; "
    "\xe2\x80\xa8 \xe2\x80\xa9 ${x} {{model}} %s\n\t\x01\x7f end";

std::string page(const PageContent& content)
{
    std::ostringstream out;
    const std::uint64_t bytes = writePage(out, content);
    EXPECT_EQ(bytes, out.str().size());
    return out.str();
}

PageContent content(const std::string& title = "a droplet", const std::string& report = "{}")
{
    return {title, "glTF" + std::string("\x02\x00\x00\x00", 4), report};
}

/// Content between the tag that begins with these words and its end tag.
std::string element(const std::string& html, const std::string& opening, const std::string& closing)
{
    const auto at = html.find(opening);
    const auto begin = html.find('>', at) + 1;
    return at == std::string::npos ? "" : html.substr(begin, html.find(closing, begin) - begin);
}

std::string script(const std::string& html, const std::string& id)
{
    return element(html, "<script id=\"" + id + "\"", "</script>");
}

nlohmann::json contentOf(const std::string& html)
{
    return nlohmann::json::parse(script(html, "content"));
}

std::size_t countOf(const std::string& text, const std::string& word)
{
    std::size_t count = 0;
    for (auto at = text.find(word); at != std::string::npos; at = text.find(word, at + 1)) {
        ++count;
    }
    return count;
}

TEST(Page, IsOneSelfContainedHtmlFile)
{
    const std::string html = page(content());
    EXPECT_THAT(html, StartsWith("<!doctype html>"));
    EXPECT_THAT(html, HasSubstr("default-src 'none'"));
    EXPECT_THAT(html, Not(HasSubstr(" src=\"")));
    EXPECT_EQ(countOf(html, " href="), 1U);
    EXPECT_THAT(html, HasSubstr("href=\"data:image/svg+xml,"));
    for (const char* slot : {"{{title}}", "{{content}}", "{{model}}"}) {
        EXPECT_THAT(html, Not(HasSubstr(slot)));
    }
}

TEST(Page, KeepsTheNoticesOfItsLicences)
{
    const std::string html = page(content());
    const std::string notice = html.substr(0, html.find("-->"));
    EXPECT_THAT(notice, HasSubstr("SPDX-License-Identifier: MIT"));
    EXPECT_THAT(notice, HasSubstr("three.js authors"));
    EXPECT_THAT(notice, HasSubstr("The above copyright notice and this permission notice shall be included in"));
}

TEST(Page, StaysSmall)
{
    // Most of it is three.js; the player of `flow`, with three's BatchedMesh, takes 28 000 bytes.
    EXPECT_LT(page(content()).size(), 745'000U);
}

TEST(Page, HoldsTheModelByteForByte)
{
    std::string glb = "glTF";
    for (int length = 0; length < 9; ++length) {
        EXPECT_EQ(testing::decodedBase64(script(page({"", glb, "{}"}), "model")), glb);
        glb += static_cast<char>(255 - 40 * length);
    }
    std::string long_glb = "glTF";
    for (int i = 0; i < 200'000; ++i) {
        long_glb += static_cast<char>(i * 7 + i / 251);
    }
    EXPECT_EQ(testing::decodedBase64(script(page({"", long_glb, "{}"}), "model")), long_glb);
}

TEST(Page, HoldsTitleAndReport)
{
    const std::string html = page(content("Tröpfchen", R"({"shape": {"volume_m3": 1.0000000000000002e-9}})"));
    EXPECT_EQ(element(html, "<title", "</title>"), "Tröpfchen");
    EXPECT_EQ(contentOf(html)["title"], "Tröpfchen");
    EXPECT_EQ(contentOf(html)["report"]["shape"]["volume_m3"], 1.0000000000000002e-9);
}

TEST(Page, NothingBreaksOutOfItsElement)
{
    const std::string plain = page(content());
    const nlohmann::json report{{"input", {{"path", kHostile}}}, {"warnings", {kHostile}}, {kHostile, kHostile}};
    const std::string html = page(content(kHostile, report.dump()));
    EXPECT_EQ(contentOf(html)["title"], kHostile);
    EXPECT_EQ(contentOf(html)["report"], report);
    // There are as many tags as without it.
    for (const std::string word : {"<script", "</script", "<!--", "<title", "</title"}) {
        EXPECT_EQ(countOf(html, word), countOf(plain, word)) << word;
    }
    EXPECT_THAT(script(html, "content"), Not(HasSubstr("<")));
    EXPECT_THAT(element(html, "<title", "</title>"), HasSubstr("&lt;/script>&lt;script>alert(1)"));
    EXPECT_THAT(element(html, "<title", "</title>"), HasSubstr("&amp;lt;/title&amp;gt;"));
}

TEST(Page, BytesThatAreNotUtf8AreReplaced)
{
    const std::string html = page(content("caf\xe9 \xff", "{}"));
    EXPECT_EQ(element(html, "<title", "</title>"), "caf\xef\xbf\xbd \xef\xbf\xbd");
    EXPECT_EQ(contentOf(html)["title"], "caf\xef\xbf\xbd \xef\xbf\xbd");
}

TEST(Page, LeavesOutTimesAndMemory)
{
    Report report;
    std::ostringstream first;
    writeReport(first, report);
    report.time_total = 12.5;
    report.time.fill(3.25);
    report.peak_memory = 123456789;
    std::ostringstream second;
    writeReport(second, report);
    ASSERT_NE(first.str(), second.str());
    const std::string html = page(content("", first.str()));
    EXPECT_EQ(html, page(content("", second.str())));
    EXPECT_FALSE(contentOf(html)["report"].contains("time_s"));
    EXPECT_FALSE(contentOf(html)["report"].contains("peak_memory_bytes"));
    EXPECT_TRUE(contentOf(html)["report"].contains("shape"));
}

TEST(Page, RefusesInvalidContent)
{
    const auto refusal = [](const PageContent& wrong) -> std::string {
        std::ostringstream out;
        try {
            writePage(out, wrong);
        } catch (const Error& error) {
            EXPECT_EQ(error.code(), ErrorCode::InvalidArgument);
            EXPECT_EQ(out.str(), "") << "nothing is written then";
            return error.what();
        }
        return "";
    };
    EXPECT_THAT(refusal({"", "", "{}"}), HasSubstr("content.glb must be a GLB file"));
    EXPECT_THAT(refusal({"", "glT", "{}"}), HasSubstr("content.glb must be a GLB file"));
    EXPECT_THAT(refusal({"", R"({"asset": {}})", "{}"}), HasSubstr("content.glb must be a GLB file"));
    for (const char* report : {"", "{", "[]", "1", "{} {}"}) {
        EXPECT_THAT(refusal({"", "glTF", report}), HasSubstr("content.report must be a JSON object")) << report;
    }
}

TEST(Page, LeavesAStreamFailedThatIsFull)
{
    std::ostringstream out;
    out.setstate(std::ios::badbit);
    writePage(out, content());
    EXPECT_TRUE(out.fail());
}

}  // namespace
}  // namespace droplet
