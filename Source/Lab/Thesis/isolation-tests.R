# SPDX-License-Identifier: MIT
# The tests of 3.1.1 of attenuation ratios: Rscript isolation-tests.R GAMMAS.csv [TESTS.csv [PICTURE.svg]], with what `physvib attenuation FOLDER --export` wrote.
# A condition is the mean of its repetitions. Normality by Shapiro and Wilk; two silicones by Mann and Whitney's U, other factors by Kruskal and Wallis;
# pairs of levels by Wilcoxon's signed ranks of conditions that are alike in all else, with Bonferroni's correction. Levels that share no letter differ
# at 0.05, as in Fig. 3.4, which the picture is: mean gamma of each level with its 95 % interval and its letters.
arguments <- commandArgs(TRUE)
options(warn = -1, width = 200) # of ties, where p is not exact
d <- read.csv(arguments[1], comment.char = "#", colClasses = "character")
factors <- Filter(function(f) length(unique(d[[f]])) > 1, intersect(c("material", "frequency_hz", "axis", "softener_percent", "thickness_mm", "voltage_v"), names(d)))
d <- aggregate(list(gamma = as.numeric(d$gamma)), d[factors], mean)
levels.of <- function(f) { own <- unique(d[[f]]); own[order(suppressWarnings(as.numeric(own)), own)] }
results <- data.frame(); charts <- character()
result <- function(factor, test, levels, statistic, p, n, p_bonferroni = NA) results <<- rbind(results, data.frame(factor, test, levels, statistic, p, p_bonferroni, n))
# Bars of one factor as SVG, the number-th of the picture; letters above their intervals.
chart <- function(f, own, means, half, letters, number) {
  half[is.na(half)] <- 0; most <- 0.5 * ceiling(2 * (max(means + half) + 0.1))
  y <- function(gamma) round(292 - 240 * gamma / most, 2); x <- 66 + 600 * (seq_along(own) - 0.5) / length(own)
  text <- function(x, y, words, rest = ' text-anchor="middle"') sprintf('<text x="%.2f" y="%.2f" font-size="12" fill="#222"%s>%s</text>', x, y, rest, gsub("<", "&lt;", gsub("&", "&amp;", words)))
  line <- function(x1, y1, x2, y2, colour = "#222", width = 1) sprintf('<line x1="%.2f" y1="%.2f" x2="%.2f" y2="%.2f" stroke="%s" stroke-width="%s"/>', x1, y1, x2, y2, colour, width)
  ticks <- seq(0, most, 0.5); low <- y(pmax(0, means - half)); high <- y(means + half)
  words <- c(material = "silicone", frequency_hz = "frequency (Hz)", softener_percent = "softener (%)", thickness_mm = "thickness (mm)", voltage_v = "voltage (V)", axis = "axis")[[f]]
  c(sprintf('<g transform="translate(0 %d)">', 338 * number), text(8, 18, paste("Gamma by", words), ' font-weight="bold"'),
    line(66, y(ticks), 666, y(ticks), "#ddd"), text(59, y(ticks) + 4, sprintf("%.1f", ticks), ' text-anchor="end"'), line(66, 52, 66, 292),
    text(35, 172, "gamma (Eq. 3.2), mean", ' text-anchor="middle" transform="rotate(-90 35 172)"'),
    sprintf('<rect x="%.2f" y="%.2f" width="42" height="%.2f" fill="#0072B2" stroke="#222"/>', x - 21, y(means), 292 - y(means)),
    line(x, low, x, high, "#fff", 3.4), line(x, low, x, high, "#000", 1.4), line(x - 4, low, x + 4, low, "#000", 1.4), line(x - 4, high, x + 4, high, "#000", 1.4),
    line(66, 292, 666, 292), text(x, high - 6, letters, ' text-anchor="middle" font-weight="bold"'), text(x, 308, own), text(366, 330, words), "</g>")
}
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
  differ <- if (differ) vapply(own, function(l) paste(LETTERS[which(vapply(letters.of, function(s) l %in% s, NA))], collapse = ""), "") else rep("", length(own))
  for (i in seq_along(own)) cat(f, " ", own[i], ": mean gamma ", format(means[i], digits = 3), if (differ[i] != "") ", ", differ[i], "\n", sep = "")
  charts <- c(charts, chart(f, own, means, sapply(groups, function(g) qt(0.975, length(g) - 1) * sd(g) / sqrt(length(g))), differ, sum(charts == "</g>")))
}
print(format(results, digits = 3), row.names = FALSE)
normal <- results$test == "Shapiro-Wilk W"
cat(sum(results$p[normal] < 0.05), "of", sum(normal), "levels are not normal at 0.05\n")
if (length(arguments) > 1) write.csv(results, arguments[2], row.names = FALSE)
if (length(arguments) > 2) writeLines(c(sprintf('<svg xmlns="http://www.w3.org/2000/svg" role="img" viewBox="0 0 680 %d" width="680" height="%1$d" font-family="Helvetica, Arial, sans-serif">', 338 * sum(charts == "</g>")),
  "<title>Mean gamma by factor, with 95 % intervals; levels that share no letter differ</title>", '<rect width="100%" height="100%" fill="#fff"/>', charts, "</svg>"), arguments[3])
