// The techniques' headers, for the host: what can be set of them, and what they show. A folder whose techniques have
// settings or debug views of their own has rows here.
#ifndef FB_ESTIMATORS_TECHNIQUES_H
#define FB_ESTIMATORS_TECHNIQUES_H
#include "estimators/ddgi/ddgi.h"
#include "estimators/mcpg/mcpg.h"
#include "estimators/mir/mir.h"
#include "estimators/pstf/pstf.h"
#include "estimators/restir/restir.h"
#include "estimators/ssmm/ssmm.h"

// Groups of settings: G(title, rows, X), X being what is made of each row (shared/settings.h).
#define FB_TECHNIQUE_SETTINGS(G, X)               \
  G("Path guiding", FB_MCPG_SETTINGS, X)          \
  G("ReSTIR", FB_RESTIR_SETTINGS, X)              \
  G("Screen-space mixtures", FB_SSMM_SETTINGS, X) \
  G("Fields of light", FB_PSTF_SETTINGS, X)       \
  G("Reweighting", FB_MIR_SETTINGS, X)            \
  G("Probes", FB_DDGI_SETTINGS, X)

// Debug views.
#define FB_TECHNIQUE_VIEWS(X) \
  FB_MCPG_VIEWS(X)            \
  FB_RESTIR_VIEWS(X)          \
  FB_SSMM_VIEWS(X)            \
  FB_PSTF_VIEWS(X)            \
  FB_DDGI_VIEWS(X)

#endif
