# SPDX-License-Identifier: MIT
# The tests of 3.1.1 of attenuation ratios: Rscript isolation-tests.R GAMMAS.csv [TESTS.csv], with what `physvib attenuation FOLDER --export` wrote.
# A condition is the mean of its repetitions. Normality by Shapiro and Wilk; two silicones by Mann and Whitney's U, other factors by Kruskal and Wallis;
# pairs of levels by Wilcoxon's signed ranks of conditions that are alike in all else, with Bonferroni's correction. Levels that share no letter differ
# at 0.05, as in Fig. 3.4.
arguments <- commandArgs(TRUE)
options(warn = -1, width = 200) # of ties, where p is not exact
d <- read.csv(arguments[1], comment.char = "#", colClasses = "character")
factors <- Filter(function(f) length(unique(d[[f]])) > 1, intersect(c("material", "frequency_hz", "axis", "softener_percent", "thickness_mm", "voltage_v"), names(d)))
d <- aggregate(list(gamma = as.numeric(d$gamma)), d[factors], mean)
levels.of <- function(f) { own <- unique(d[[f]]); own[order(suppressWarnings(as.numeric(own)), own)] }
results <- data.frame()
result <- function(factor, test, levels, statistic, p, n, p_bonferroni = NA) results <<- rbind(results, data.frame(factor, test, levels, statistic, p, p_bonferroni, n))
for (f in factors) {
  own <- levels.of(f); groups <- lapply(own, function(l) d$gamma[d[[f]] == l])
  for (i in seq_along(own)) if (length(unique(groups[[i]])) > 2) {
    y <- groups[[i]]; if (length(y) > 5000) y <- y[round(seq(1, length(y), length.out = 5000))] # the most that R takes
    s <- shapiro.test(y); result(f, "Shapiro-Wilk W", own[i], s$statistic, s$p.value, length(y))
  }
  if (f == "material" && length(own) == 2) {
    t <- wilcox.test(groups[[1]], groups[[2]]); result(f, "Mann-Whitney U", paste(own, collapse = " - "), t$statistic, t$p.value, nrow(d))
  } else {
    t <- kruskal.test(groups); result(f, paste0("Kruskal-Wallis chi-squared(", t$parameter, ")"), "all", t$statistic, t$p.value, nrow(d))
  }
  two <- combn(own, 2, simplify = FALSE); others <- setdiff(factors, f)
  key <- if (length(others) > 0) do.call(paste, d[others]) else rep("", nrow(d))
  tests <- lapply(two, function(l) {
    a <- setNames(d$gamma, key)[d[[f]] == l[1]]; b <- setNames(d$gamma, key)[d[[f]] == l[2]]; both <- intersect(names(a), names(b))
    t <- if (length(both) > 0) tryCatch(wilcox.test(a[both], b[both], paired = TRUE), error = function(e) NULL)
    if (is.null(t)) list(statistic = NA, p.value = NA, n = length(both)) else c(t[c("statistic", "p.value")], n = length(both))
  })
  corrected <- p.adjust(sapply(tests, function(t) t$p.value), "bonferroni", length(two))
  letters.of <- list(own) # each a set of levels that do not differ: Piepho's insert and absorb
  for (k in seq_along(two)) {
    result(f, "Wilcoxon V", paste(two[[k]], collapse = " - "), tests[[k]]$statistic, tests[[k]]$p.value, tests[[k]]$n, corrected[k])
    if (is.na(corrected[k]) || corrected[k] >= 0.05) next
    letters.of <- unlist(lapply(letters.of, function(s) if (all(two[[k]] %in% s)) list(setdiff(s, two[[k]][1]), setdiff(s, two[[k]][2])) else list(s)), recursive = FALSE)
    letters.of <- unique(Filter(function(s) !any(vapply(letters.of, function(other) length(other) > length(s) && all(s %in% other), NA)), letters.of))
  }
  means <- sapply(groups, mean); differ <- isTRUE(t$p.value < 0.05)
  letters.of <- letters.of[order(-sapply(letters.of, function(s) max(means[own %in% s])))]
  for (i in seq_along(own)) cat(f, " ", own[i], ": mean gamma ", format(means[i], digits = 3), if (differ) ", ",
                                if (differ) paste(LETTERS[which(vapply(letters.of, function(s) own[i] %in% s, NA))], collapse = ""), "\n", sep = "")
}
print(format(results, digits = 3), row.names = FALSE)
normal <- results$test == "Shapiro-Wilk W"
cat(sum(results$p[normal] < 0.05), "of", sum(normal), "levels are not normal at 0.05\n")
if (length(arguments) > 1) write.csv(results, arguments[2], row.names = FALSE)
