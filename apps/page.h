// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef PGDR_APPS_PAGE_H
#define PGDR_APPS_PAGE_H

namespace pgdr::app {

/// What apps/page is bundled to; null where the program was built without npm.
extern const char* const page_script;
extern const char* const page_style;

}  // namespace pgdr::app

#endif
