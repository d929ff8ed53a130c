#pragma once

#include <string_view>

namespace vellus::demo {

/// The files page/page.html, .css and .js as they were when the program was built. The first has a
/// line "@css@", "@js@" and "@data@" each, where the others and the rows go.
struct PageTemplate {
    std::string_view html;
    std::string_view css;
    std::string_view js;
};
const PageTemplate& page_template();

}  // namespace vellus::demo
