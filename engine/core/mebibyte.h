#pragma once

/** Bytes of what users are told and give as MiB. */
#define NOOK_MIB 1048576.0
