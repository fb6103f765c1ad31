#include "render/font.hpp"

#include "render/picture.hpp"

#include <cairo-ft.h>

// RDDL_FONT_FILE is put here byte by byte (render/CMakeLists.txt names the file).
__asm__(
    ".section .rodata\n"
    ".balign 16\n"
    "rddl_render_font_begin:\n"
    ".incbin \"" RDDL_FONT_FILE
    "\"\n"
    "rddl_render_font_end:\n"
    ".byte 0\n"
    ".previous\n");
extern "C" {
extern const unsigned char rddl_render_font_begin[], rddl_render_font_end[];
}

namespace rddl::render {

namespace {

cairo_font_face_t* read_font() {
    FT_Library library;
    FT_Face face;
    if (FT_Init_FreeType(&library) != 0) throw Error("FreeType does not start");
    const auto size = static_cast<FT_Long>(rddl_render_font_end - rddl_render_font_begin);
    if (FT_New_Memory_Face(library, rddl_render_font_begin, size, 0, &face) != 0)
        throw Error("the font that was built in cannot be read");
    return cairo_ft_font_face_create_for_ft_face(face, FT_LOAD_NO_HINTING);
}

}  // namespace

cairo_font_face_t* font_face() {
    // The font lives as long as the process: FreeType's faces are not given back before cairo's
    // caches are.
    static cairo_font_face_t* const face = read_font();
    return face;
}

}  // namespace rddl::render
