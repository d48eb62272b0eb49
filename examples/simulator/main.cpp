// SPDX-License-Identifier: GPL-3.0-or-later
// Rain on a windshield in a window, as it falls.
//
//   simulator [--frames N] [--shot FILE.png]
//
// Up and down change the speed, left and right the rain, W switches the wipers, Escape ends. Each second it prints
// frames per second and what they cost. --shot writes the last of N frames, beside it the ray-traced view of the same
// state, and prints the mean difference of their levels.
#include <droplet/drawing/picture.h>
#include <droplet/error.h>
#include <droplet/units.h>
#include <droplet/windshield/presets.h>
#include <droplet/windshield/windshield.h>
#include <droplet/windshield_view/view.h>
#include <droplet/windshield_view/windshield_maps.h>
#include <epoxy/gl.h>
// epoxy comes first
#include <GLFW/glfw3.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <iostream>
#include <sstream>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace {

using droplet::Vec2;
using droplet::Vec3;

constexpr double kStep = 1.0 / 60.0;
constexpr int kWidth = 1280;
constexpr int kHeight = 720;

constexpr const char* kBladeShader = "out vec4 colour;\nvoid main() { colour = vec4(0.012, 0.012, 0.014, 1.0); }\n";

GLuint shaderOf(GLenum kind, const std::string& text)
{
    const std::string whole = "#version 330 core\n" + text;
    const char* const lines = whole.c_str();
    const GLuint shader = glCreateShader(kind);
    glShaderSource(shader, 1, &lines, nullptr);
    glCompileShader(shader);
    GLint compiled = 0;
    glGetShaderiv(shader, GL_COMPILE_STATUS, &compiled);
    if (compiled == 0) {
        std::array<char, 2000> log{};
        glGetShaderInfoLog(shader, log.size(), nullptr, log.data());
        throw std::runtime_error(log.data());
    }
    return shader;
}

std::string textOf(const char* path)
{
    std::ifstream file(path);
    std::stringstream text;
    text << file.rdbuf();
    if (!file) {
        throw std::runtime_error(std::string(path) + " cannot be read");
    }
    return text.str();
}

GLuint programOf(const std::string& fragment)
{
    const GLuint program = glCreateProgram();
    glAttachShader(program, shaderOf(GL_VERTEX_SHADER, textOf(SIMULATOR_SHADERS "glass.glsl")));
    glAttachShader(program, shaderOf(GL_FRAGMENT_SHADER, fragment));
    glLinkProgram(program);
    return program;
}

/// Vertices of a part of the glass: place, normal, tangents, place in the map.
struct Mesh {
    std::vector<float> numbers;
    GLuint array = 0;
    GLuint buffer = 0;

    Mesh()
    {
        glGenVertexArrays(1, &array);
        glGenBuffers(1, &buffer);
        glBindVertexArray(array);
        glBindBuffer(GL_ARRAY_BUFFER, buffer);
        constexpr std::array<int, 5> kSizes{3, 3, 3, 3, 2};
        std::size_t offset = 0;
        for (GLuint k = 0; k < kSizes.size(); ++k) {
            glEnableVertexAttribArray(k);
            glVertexAttribPointer(k, kSizes[k], GL_FLOAT, GL_FALSE, 14 * sizeof(float),
                                  reinterpret_cast<const void*>(offset));
            offset += static_cast<std::size_t>(kSizes[k]) * sizeof(float);
        }
    }

    /// @param position  on the unrolled glass
    void add(const droplet::Glass& glass, Vec2 position, const droplet::GlassPlace& place)
    {
        for (const Vec3& v : {place.point, place.normal, place.across, place.up}) {
            numbers.insert(numbers.end(), {static_cast<float>(v.x), static_cast<float>(v.y), static_cast<float>(v.z)});
        }
        numbers.push_back(static_cast<float>(position.x / glass.width()));
        numbers.push_back(static_cast<float>(1.0 - position.y / glass.height()));
    }

    void draw(GLenum usage)
    {
        glBindVertexArray(array);
        glBindBuffer(GL_ARRAY_BUFFER, buffer);
        glBufferData(GL_ARRAY_BUFFER, static_cast<GLsizeiptr>(numbers.size() * sizeof(float)), numbers.data(), usage);
        glDrawArrays(GL_TRIANGLES, 0, static_cast<GLsizei>(numbers.size() / 14));
    }
};

void addGlass(Mesh& mesh, const droplet::Glass& glass)
{
    for (const droplet::GlassTriangle& triangle : glass.triangles()) {
        for (std::size_t k = 0; k < 3; ++k) {
            mesh.add(glass, triangle.positions[k], triangle.places[k]);
        }
    }
}

void addBlade(Mesh& mesh, const droplet::Glass& glass, const droplet::Wiper& wiper, double time)
{
    const double angle = wiper.angleAt(time);
    const Vec2 along{std::cos(angle), std::sin(angle)};
    const Vec2 half = 0.005 * Vec2{-along.y, along.x};
    const Vec2 from = wiper.pivot + wiper.inner * along;
    const Vec2 to = wiper.pivot + wiper.outer * along;
    for (const Vec2 p : {from - half, to - half, to + half, from - half, to + half, from + half}) {
        // Blades rest below the glass, where its edge goes on straight.
        const Vec2 inside{std::clamp(p.x, 0.0, glass.width()), std::clamp(p.y, 0.0, glass.height())};
        droplet::GlassPlace place = glass.place(inside).value();
        place.point = place.point + (p.x - inside.x) * place.across + (p.y - inside.y) * place.up;
        mesh.add(glass, inside, place);
    }
}

struct Driver {
    double speed = 15.0;    // [m/s]
    double rainfall = 5.0;  // [mm/h]
    bool wipes = false;
};

void onKey(GLFWwindow* window, int key, int /*code*/, int action, int /*modifiers*/)
{
    Driver& driver = *static_cast<Driver*>(glfwGetWindowUserPointer(window));
    if (action == GLFW_RELEASE) {
        return;
    }
    switch (key) {
        case GLFW_KEY_UP:
            driver.speed = std::min(driver.speed + 1.0, 60.0);
            break;
        case GLFW_KEY_DOWN:
            driver.speed = std::max(driver.speed - 1.0, 0.0);
            break;
        case GLFW_KEY_RIGHT:
            driver.rainfall = std::min(1.25 * driver.rainfall + 0.5, 200.0);
            break;
        case GLFW_KEY_LEFT:
            driver.rainfall = std::max(0.8 * driver.rainfall - 0.5, 0.0);
            break;
        case GLFW_KEY_W:
            driver.wipes = !driver.wipes;
            break;
        case GLFW_KEY_ESCAPE:
            glfwSetWindowShouldClose(window, GLFW_TRUE);
            break;
        default:
            break;
    }
}

GLuint texture(GLenum unit, GLint filter)
{
    GLuint name = 0;
    glGenTextures(1, &name);
    glActiveTexture(unit);
    glBindTexture(GL_TEXTURE_2D, name);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, filter);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
    return name;
}

void setOutside(const droplet::Picture& picture)
{
    glActiveTexture(GL_TEXTURE1);
    glPixelStorei(GL_UNPACK_ALIGNMENT, 1);
    glPixelStorei(GL_UNPACK_ROW_LENGTH, 0);
    glTexImage2D(GL_TEXTURE_2D, 0, GL_SRGB8, picture.width, picture.height, 0, GL_RGB, GL_UNSIGNED_BYTE,
                 picture.rgb.data());
    glGenerateMipmap(GL_TEXTURE_2D);
}

droplet::Picture grabbed()
{
    droplet::Picture picture{kWidth, kHeight, std::vector<std::uint8_t>(std::size_t{3} * kWidth * kHeight)};
    std::vector<std::uint8_t> rows(picture.rgb.size());
    glPixelStorei(GL_PACK_ALIGNMENT, 1);
    glReadPixels(0, 0, kWidth, kHeight, GL_RGB, GL_UNSIGNED_BYTE, rows.data());
    constexpr std::size_t kRow = std::size_t{3} * kWidth;
    for (std::size_t y = 0; y < kHeight; ++y) {
        std::copy_n(rows.begin() + static_cast<std::ptrdiff_t>((kHeight - 1 - y) * kRow), kRow,
                    picture.rgb.begin() + static_cast<std::ptrdiff_t>(y * kRow));
    }
    return picture;
}

/// Levels of 2 µm for the thickness of a film, upper row first.
std::vector<std::uint8_t> levelsOf(const droplet::Runoff& film)
{
    constexpr double kLevels = droplet::Runoff::kThickness / 2e-6;
    std::vector<std::uint8_t> levels(film.thickness.size());
    for (std::size_t k = 0; k < levels.size(); ++k) {
        const std::size_t row = film.rows - 1 - k / film.columns;
        levels[row * film.columns + k % film.columns] =
            static_cast<std::uint8_t>(std::min(kLevels * film.thickness[k] + 0.5, 255.0));
    }
    return levels;
}

/// Sets a texture of one channel.
void setLevels(GLenum unit, int width, int height, const std::uint8_t* levels)
{
    glActiveTexture(unit);
    glPixelStorei(GL_UNPACK_ALIGNMENT, 1);
    glPixelStorei(GL_UNPACK_ROW_LENGTH, 0);
    glTexImage2D(GL_TEXTURE_2D, 0, GL_R8, width, height, 0, GL_RED, GL_UNSIGNED_BYTE, levels);
}

void save(const droplet::Picture& picture, const std::string& path)
{
    std::ofstream file(path, std::ios::binary);
    droplet::writePng(picture, file);
}

struct Arguments {
    int frames = 0;  // 0: until the window is closed
    std::string shot;
};

void run(const Arguments& arguments, GLFWwindow* window)
{
    Driver driver;
    glfwSetWindowUserPointer(window, &driver);
    glfwSetKeyCallback(window, onKey);

    droplet::WindshieldParameters parameters = droplet::windshieldPresetNamed("figure-3.12").parameters;
    parameters.runoff = 1.0;
    const droplet::Glass& glass = parameters.glass;
    const std::vector<droplet::Wiper> wipers = droplet::tandemWipers(glass, 1.2);
    droplet::ViewOptions view;
    view.width = kWidth;
    view.height = kHeight;
    view.shape.contact_angle = parameters.forces.wetting.contact_angle;
    const droplet::DefaultBackground road(view);
    const droplet::Picture behind = road.at(0.0);
    droplet::WindshieldMaps maps(glass, {.width = 2048, .shape = view.shape});
    std::vector<std::uint16_t> pixels(std::size_t{4} * static_cast<std::size_t>(maps.width()) *
                                      static_cast<std::size_t>(maps.height()));

    const auto middle = glass.place({0.5 * glass.width(), 0.5 * glass.height()});
    const Vec3 eye = middle->point - Vec3{0.0, view.eye_distance, 0.0};
    const float tangent = static_cast<float>(std::tan(0.5 * view.field_of_view));
    const GLuint rain = programOf(textOf(SIMULATOR_SHADERS "rain.glsl"));
    const GLuint blade = programOf(kBladeShader);
    for (const GLuint program : {rain, blade}) {
        glUseProgram(program);
        glUniform3f(glGetUniformLocation(program, "eye"), static_cast<float>(eye.x), static_cast<float>(eye.y),
                    static_cast<float>(eye.z));
        glUniform2f(glGetUniformLocation(program, "tangent"), tangent, tangent * kHeight / kWidth);
    }
    glUseProgram(rain);
    glUniform1i(glGetUniformLocation(rain, "water"), 0);
    glUniform1i(glGetUniformLocation(rain, "outside"), 1);
    glUniform1i(glGetUniformLocation(rain, "dry"), 1);
    glUniform1i(glGetUniformLocation(rain, "mist"), 2);
    glUniform2f(glGetUniformLocation(rain, "mist_edge"), 1.0F, 1.0F);
    glUniform1i(glGetUniformLocation(rain, "film"), 3);
    glUniform2f(glGetUniformLocation(rain, "film_edge"), 1.0F, 1.0F);
    glUniform2f(glGetUniformLocation(rain, "wide"), tangent, tangent * kHeight / kWidth);
    const double contact_angle = std::min(view.shape.contact_angle, 90.0 * droplet::kDegree);
    glUniform1f(glGetUniformLocation(rain, "rim"), static_cast<float>(std::sin(contact_angle)));
    glUniform1f(glGetUniformLocation(rain, "blur"), 0.0F);
    glUniform1f(glGetUniformLocation(rain, "border"), 0.0F);
    glUniform2f(glGetUniformLocation(rain, "glass"), static_cast<float>(glass.width()),
                static_cast<float>(glass.height()));
    glUniform3f(glGetUniformLocation(rain, "cabin"), 0.01F, 0.01F, 0.012F);

    texture(GL_TEXTURE0, GL_LINEAR);
    glTexImage2D(GL_TEXTURE_2D, 0, GL_RGBA16F, maps.width(), maps.height(), 0, GL_RGBA, GL_HALF_FLOAT, pixels.data());
    texture(GL_TEXTURE1, GL_LINEAR_MIPMAP_LINEAR);
    setOutside(behind);
    constexpr std::uint8_t kNone = 0;
    for (const GLenum unit : {GL_TEXTURE2, GL_TEXTURE3}) {
        texture(unit, GL_LINEAR);
        setLevels(unit, 1, 1, &kNone);
    }
    Mesh pane;
    addGlass(pane, glass);
    glEnable(GL_FRAMEBUFFER_SRGB);

    droplet::WindshieldState state = droplet::startWindshield(parameters);
    double counted_from = glfwGetTime();
    double busy = 0.0;
    int counted = 0;
    for (int frame = 0; !glfwWindowShouldClose(window) && (arguments.frames == 0 || frame < arguments.frames);
         ++frame) {
        const double begin = glfwGetTime();
        parameters.vehicle = droplet::constantSpeed(driver.speed);
        parameters.rainfall = driver.rainfall * droplet::kMillimetrePerHour;
        parameters.wipers = driver.wipes ? wipers : std::vector<droplet::Wiper>();
        state = droplet::step(std::move(state), parameters, kStep);
        const std::vector<droplet::MapTile>& tiles = maps.update(state, pixels);
        busy += glfwGetTime() - begin;

        glActiveTexture(GL_TEXTURE0);
        glPixelStorei(GL_UNPACK_ROW_LENGTH, maps.width());
        for (const droplet::MapTile& tile : tiles) {
            glTexSubImage2D(GL_TEXTURE_2D, 0, tile.x, tile.y, tile.width, tile.height, GL_RGBA, GL_HALF_FLOAT,
                            pixels.data() + std::size_t{4} * (static_cast<std::size_t>(tile.y) *
                                                                  static_cast<std::size_t>(maps.width()) +
                                                              static_cast<std::size_t>(tile.x)));
        }
        if (const droplet::Runoff& film = state.film; !film.thickness.empty()) {
            setLevels(GL_TEXTURE3, static_cast<int>(film.columns), static_cast<int>(film.rows), levelsOf(film).data());
            glUseProgram(rain);
            glUniform2f(glGetUniformLocation(rain, "film_edge"),
                        static_cast<float>(film.columns * film.cell / glass.width()),
                        static_cast<float>(film.rows * film.cell / glass.height()));
            glUniform2f(glGetUniformLocation(rain, "drift"), static_cast<float>(film.drift.x),
                        static_cast<float>(-film.drift.y));
        }
        glClearColor(0.0F, 0.0F, 0.0F, 1.0F);
        glClear(GL_COLOR_BUFFER_BIT);
        glUseProgram(rain);
        pane.draw(GL_STATIC_DRAW);
        if (driver.wipes) {
            Mesh blades;
            for (const droplet::Wiper& wiper : wipers) {
                addBlade(blades, glass, wiper, state.time);
            }
            glUseProgram(blade);
            blades.draw(GL_STREAM_DRAW);
            glDeleteBuffers(1, &blades.buffer);
            glDeleteVertexArrays(1, &blades.array);
        }
        if (frame + 1 == arguments.frames && !arguments.shot.empty()) {
            const droplet::Picture drawn = grabbed();
            droplet::DriversView traced(glass, view);
            traced.setBackground(behind);
            traced.show(state);
            const droplet::Picture exact = traced.frame();
            double difference = 0.0;
            for (std::size_t k = 0; k < exact.rgb.size(); ++k) {
                difference += std::abs(exact.rgb[k] - drawn.rgb[k]);
            }
            save(drawn, arguments.shot);
            save(exact, arguments.shot.substr(0, arguments.shot.rfind('.')) + "-traced.png");
            std::cout << "mean difference from the ray-traced view: "
                      << difference / static_cast<double>(exact.rgb.size()) << " levels of 255\n";
        }
        glfwSwapBuffers(window);
        glfwPollEvents();
        ++counted;
        const double passed = glfwGetTime() - counted_from;
        if (passed >= 1.0 || frame + 1 == arguments.frames) {
            std::cout << counted / passed << " frames/s; simulation and maps " << 1e3 * busy / counted
                      << " ms a frame; " << driver.speed << " m/s, " << driver.rainfall << " mm/h, "
                      << state.droplets.size() << " run, " << state.still.count() << " rest\n";
            counted_from = glfwGetTime();
            busy = 0.0;
            counted = 0;
        }
    }
}

}  // namespace

int main(int argc, char** argv)
{
    Arguments arguments;
    for (int k = 1; k < argc; ++k) {
        if (std::strcmp(argv[k], "--frames") == 0 && k + 1 < argc) {
            arguments.frames = std::atoi(argv[++k]);
        } else if (std::strcmp(argv[k], "--shot") == 0 && k + 1 < argc) {
            arguments.shot = argv[++k];
        } else {
            std::cerr << "usage: simulator [--frames N] [--shot FILE.png]\n";
            return 2;
        }
    }
    if (glfwInit() == GLFW_FALSE) {
        std::cerr << "simulator: no display\n";
        return 1;
    }
    int code = 0;
    try {
        glfwWindowHint(GLFW_CONTEXT_VERSION_MAJOR, 3);
        glfwWindowHint(GLFW_CONTEXT_VERSION_MINOR, 3);
        glfwWindowHint(GLFW_OPENGL_PROFILE, GLFW_OPENGL_CORE_PROFILE);
        glfwWindowHint(GLFW_SRGB_CAPABLE, GLFW_TRUE);
        glfwWindowHint(GLFW_RESIZABLE, GLFW_FALSE);
        GLFWwindow* const window = glfwCreateWindow(kWidth, kHeight, "Rain on a windshield", nullptr, nullptr);
        if (window == nullptr) {
            throw std::runtime_error("no OpenGL 3.3");
        }
        glfwMakeContextCurrent(window);
        run(arguments, window);
    } catch (const std::exception& error) {  // droplet::Error among them
        std::cerr << "simulator: " << error.what() << "\n";
        code = 1;
    }
    glfwTerminate();
    return code;
}
