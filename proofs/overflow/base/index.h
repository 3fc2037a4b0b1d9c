/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* In place of src/base/index.h: what sorts by dyd_compare_index has a stand-in. */
