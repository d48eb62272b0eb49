# SPDX-License-Identifier: GPL-3.0-or-later
# Formula for Homebrew; not run by the project.
class DropletShape < Formula
  desc "3D droplets of liquid from the pictures of their footprints"
  homepage "https://droplet-shape.invalid"
  url "https://droplet-shape.invalid/releases/droplet-shape-0.3.0-source.tar.gz"
  sha256 "0000000000000000000000000000000000000000000000000000000000000000"
  license "GPL-3.0-or-later"

  depends_on "cgal" => :build
  depends_on "cli11" => :build
  depends_on "cmake" => :build
  depends_on "eigen" => :build
  depends_on "ninja" => :build
  depends_on "nlohmann-json" => :build
  depends_on "pkgconf" => :build
  depends_on "tomlplusplus" => :build
  depends_on "cairo"
  depends_on "embree"
  depends_on "fmt"
  depends_on "freetype"
  depends_on "fribidi"
  depends_on "harfbuzz"
  depends_on "jpeg-turbo"
  depends_on "libpng"
  depends_on "librsvg"
  # The parts that ask the system for files, processes and signals are written for Linux.
  depends_on :linux
  depends_on "opencv"
  depends_on "tbb"

  def install
    system "cmake", "-S", ".", "-B", "build", "-G", "Ninja", "-DDROPLET_TESTS=OFF", "-DDROPLET_PAGE=OFF", *std_cmake_args
    system "cmake", "--build", "build"
    system "cmake", "--install", "build"
  end

  def caveats
    "On macOS take the npm package: npx droplet-shape logo.png logo.glb"
  end

  test do
    (testpath/"mask.pbm").write "P1 8 8\n" + ("0 0 1 1 1 1 0 0\n" * 8)
    system bin/"droplet-shape", "mask.pbm", "droplet.glb", "--triangles", "500"
    assert_path_exists testpath/"droplet.glb"
  end
end
