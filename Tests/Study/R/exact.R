# SPDX-License-Identifier: MIT
# exact.p(a[, b]): p of signed ranks, or of Mann and Whitney's, by counting: every pattern of up to 12 signs one by one; else by groups of tied ranks,
# of which so many are chosen in choose(size, k) ways. R's own where it has p without ties.
exact.p <- function(a, b = NULL) {
  d <- if (is.null(b)) a[a != 0] else c(a, b)
  r <- if (is.null(b)) wilcox.test(a) else wilcox.test(a, b)
  if (is.nan(r$p.value) || grepl("exact", r$method) || length(d) > 60) return(r$p.value)
  ranks <- rank(if (is.null(b)) abs(d) else d)
  if (is.null(b) && length(d) <= 12) {
    sums <- as.matrix(expand.grid(rep(list(0:1), length(d)))) %*% ranks; v <- sum(ranks[d > 0])
    return(min(1, 2 * min(mean(sums <= v), mean(sums >= v))))
  }
  ways <- list("0 0" = c(n = 0, sum = 0, ways = 1)) # n chosen, their sum, in how many ways
  for (tied in split(ranks, ranks)) {
    ways <- do.call(rbind, ways); more <- do.call(rbind, lapply(0:length(tied), function(k) cbind(n = ways[, 1] + k, sum = ways[, 2] + k * tied[1], ways = ways[, 3] * choose(length(tied), k))))
    added <- tapply(more[, 3], if (is.null(b)) more[, 2] else paste(more[, 1], more[, 2]), sum)
    parts <- strsplit(names(added), " ", fixed = TRUE)
    ways <- Map(function(part, w) c(if (length(part) == 2) as.numeric(part) else c(0, as.numeric(part)), w), parts, added)
  }
  ways <- do.call(rbind, ways); if (!is.null(b)) ways <- ways[ways[, 1] == length(a), , drop = FALSE]
  v <- sum(ranks[if (is.null(b)) d > 0 else seq_along(a)]); of <- sum(ways[, 3])
  min(1, 2 * min(sum(ways[ways[, 2] <= v, 3]), sum(ways[ways[, 2] >= v, 3])) / of)
}
