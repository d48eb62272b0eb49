# SPDX-License-Identifier: GPL-3.0-or-later
# Flake for Nix; not run by the project.
{
  description = "3D droplets of liquid from the pictures of their footprints";

  inputs.nixpkgs.url = "nixpkgs/nixos-23.05";

  outputs = { self, nixpkgs }:
    let
      systems = [ "x86_64-linux" "aarch64-linux" ];
      each = make: nixpkgs.lib.genAttrs systems (system: make nixpkgs.legacyPackages.${system});
    in {
      packages = each (pkgs: {
        default = pkgs.stdenv.mkDerivation {
          pname = "droplet-shape";
          version = "0.3.0";
          src = self;
          nativeBuildInputs = with pkgs; [ cmake ninja pkg-config ];
          buildInputs = with pkgs; [
            boost cairo cgal cli11 clipper eigen embree fmt_9 freetype fribidi gmp harfbuzz libjpeg libmd libpng librsvg libxml2
            meshoptimizer mpfr nlohmann_json opencv openmesh tbb tinygltf tomlplusplus zlib
          ];
          cmakeFlags = [ "-DDROPLET_TESTS=OFF" "-DDROPLET_PAGE=OFF" ];
          meta = {
            description = "3D droplets of liquid from the pictures of their footprints";
            license = pkgs.lib.licenses.gpl3Plus;
            mainProgram = "droplet-shape";
            platforms = systems;
          };
        };
      });
    };
}
