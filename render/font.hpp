// The font of all pictures. It is part of the library, so that pictures are the same everywhere and
// no font server is asked.
#pragma once

struct _cairo_font_face;

namespace rddl::render {

// Stays until the process ends. Throws Error if the font cannot be read.
_cairo_font_face* font_face();

}  // namespace rddl::render
