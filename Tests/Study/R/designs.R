# SPDX-License-Identifier: MIT
# Rscript designs.R, in the folder of designs.sh: each design from its trial files, by R's own functions and without a look at analysis.R.
options(warn = -1)
source(file.path(dirname(sub("^--file=", "", grep("^--file=", commandArgs(FALSE), value = TRUE))), "exact.R"))
faults <- 0; figures <- 0
fault <- function(...) { faults <<- faults + 1; cat("FAULT:", ..., "\n") }
read <- function(file) read.csv(file, comment.char = "#", colClasses = "character")
trials <- function(design) do.call(rbind, lapply(Sys.glob(file.path("trials", paste0(design, "-P*.csv"))), read))
page <- function(design) transform(read(file.path(design, "tests.csv")), p = as.numeric(p), value = as.numeric(value), p_corrected = as.numeric(p_corrected), p_across = as.numeric(p_across))
same <- function(words, ours, r, within = 1e-6) {
  figures <<- figures + 1
  if (length(ours) != 1 || length(r) != 1 || is.na(ours) || is.na(r) || abs(ours - r) > within * max(abs(r), 1e-8)) fault(words, "is", format(ours, digits = 10), "for", format(r, digits = 10))
}
# All effects of factors within people, by strata of aov; pairs of each factor by t, corrected by Holm.
within <- function(design, measure, d, factors, p = page(design)) {
  m <- aggregate(d["y"], d[c(factors, "participant")], mean)
  for (f in c(factors, "participant")) m[[f]] <- factor(m[[f]])
  model <- as.formula(paste("y ~", paste(factors, collapse = "*"), "+ Error(participant/(", paste(factors, collapse = "*"), "))"))
  own <- p[startsWith(p$test, paste0("analysis of variance of ", measure, " by ")), ]
  for (stratum in summary(aov(model, m))) for (effect in trimws(rownames(stratum[[1]]))) if (effect != "Residuals") {
    row <- stratum[[1]][trimws(rownames(stratum[[1]])) == effect, ]; line <- own[own$effect == effect & own$statistic == "F", ]
    same(paste(design, measure, effect, "F"), line$value, row[["F value"]]); same(paste(design, measure, effect, "p"), line$p, row[["Pr(>F)"]])
  }
  if (length(factors) == 1 && nlevels(m[[factors]]) > 2) {
    wide <- tapply(m$y, list(m$participant, m[[factors]]), mean); fit <- lm(wide ~ 1)
    gg <- anova(fit, update(fit, ~ 0), X = ~ 1, M = ~ level, idata = data.frame(level = factor(seq_len(ncol(wide)))), test = "Spherical")[["G-G Pr"]][2]
    same(paste(design, measure, "Greenhouse-Geisser"), own$p_corrected[own$effect == factors], gg)
  }
  own <- p[startsWith(p$test, paste0("pairs by t of ", measure, " by ")), ]
  for (f in factors) {
    means <- tapply(m$y, list(m$participant, m[[f]]), mean); two <- combn(colnames(means), 2)
    ps <- apply(two, 2, function(l) t.test(means[, l[1]], means[, l[2]], paired = TRUE)$p.value); holm <- p.adjust(ps, "holm")
    for (i in seq_along(ps)) {
      line <- own[own$effect %in% paste0(f, ": ", c(paste(two[1, i], "-", two[2, i]), paste(two[2, i], "-", two[1, i]))), ]
      same(paste(design, measure, two[1, i], two[2, i]), line$p, ps[i]); same(paste(design, measure, "Holm", two[1, i], two[2, i]), line$p_corrected, holm[i])
    }
  }
}
word <- function(cells, name) sub(paste0(".*\\b", name, "=(\\S+).*"), "\\1", cells)

d <- trials("realism"); d <- d[d$phase == "main", ]
for (f in c("frequency", "decay", "level")) d[[f]] <- word(d$stimulus, f)
for (scale in c("realism", "hardness")) within("realism", scale, transform(d, y = as.numeric(d[[scale]])), c("frequency", "decay", "level"))

d <- trials("load"); d <- d[d$task == "rate", ]; p <- page("load")
for (scale in c("effort", "frustration")) within("load", scale, transform(d, y = as.numeric(d[[scale]])), "condition", p)
own <- p[p$effect == "condition" & p$statistic == "F" & grepl("of (effort|frustration) by", p$test), ]
for (i in 1:2) same("over both scales", own$p_across[i], p.adjust(own$p_corrected, "holm")[i])

# Subjective equality of each person: the likeliest logistic function, with as many lapses at its lower as at its upper end, up to 2 %.
d <- trials("sides"); fits <- read("sides/psychometric-stimuli.csv")
loss <- function(v, x, right) {
  f <- v[3] + (1 - 2 * v[3]) * plogis(2 * log(19) * (x - v[1]) / v[2]); f <- pmin(pmax(f, 1e-12), 1 - 1e-12)
  -sum(ifelse(right, log(f), log(1 - f)))
}
for (i in seq_len(nrow(fits))) {
  own <- d[d$participant == fits$participant[i] & d$condition == fits$condition[i], ]; x <- as.numeric(own$stimulus)
  best <- lapply(c(0.05, 0.2, 0.5, 1), function(width) optim(c(0.5, width, 0.01), loss, x = x, right = own$choice == "right", method = "L-BFGS-B",
                                                            lower = c(0, 0.01, 0), upper = c(1, 10, 0.02), control = list(factr = 10)))
  best <- best[[which.min(sapply(best, `[[`, "value"))]]
  same(paste("sides likelihood", fits$participant[i]), as.numeric(fits$log_likelihood[i]), -best$value, 1e-4)
  same(paste("sides threshold", fits$participant[i]), as.numeric(fits$threshold[i]), best$par[1], 1e-2)
}
both <- names(which(table(fits$participant) == 2)); fits <- fits[fits$participant %in% both, ]
within("sides", "point of subjective equality", transform(fits, y = as.numeric(fits$threshold)), "condition")

d <- trials("numbers"); d$x <- log10(as.numeric(d$stimulus)); d$y <- log10(as.numeric(d$value))
slopes <- do.call(rbind, lapply(split(d, list(d$participant, d$condition)), function(o) data.frame(participant = o$participant[1], condition = o$condition[1], y = coef(lm(y ~ x, o))[[2]])))
within("numbers", "exponent", slopes, "condition")
within("numbers", "log10 of magnitudes", d, c("condition", "stimulus"))

reversals <- function(levels) {
  step <- diff(levels); moved <- which(step != 0)
  turned <- which(diff(sign(step[moved])) != 0)
  levels[moved[turned + 1]]
}
d <- trials("steps")
own <- do.call(rbind, lapply(split(d, list(d$participant, d$condition)), function(o) {
  r <- reversals(as.numeric(o$level_db)); r <- r[(floor(length(r) / 2) + 1):length(r)]; at.end <- function(levels) mean(levels %in% c(0, 12)) >= 0.5
  data.frame(participant = o$participant[1], condition = o$condition[1], y = if (at.end(r) || at.end(as.numeric(o$level_db))) NA else mean(r))
}))
own <- own[!(own$participant %in% own$participant[is.na(own$y)]), ]
within("steps", "threshold", own, "condition")
d <- d[d$choice != "", ]

d <- trials("hurried"); p <- page("hurried"); late <- tapply(d$ran_out == "1", list(d$participant, d$condition), mean)
if (all(late == 0) || !all(d$correct[d$ran_out == "1"] == "" & d$response[d$ran_out == "1"] == "")) fault("a trial that ran out has an answer, or none ran out")
same("hurried, ran out", p$p[grepl("ran out of time in main", p$test) & !is.na(p$p)], exact.p(round(late[, 1] - late[, 2], 9)))
d <- d[d$ran_out == "0", ]
right <- 100 * tapply(d$correct == "1", list(d$participant, d$condition), mean); right[tapply(d$stimulus, list(d$participant, d$condition), function(s) length(unique(s))) < 9] <- NA
same("hurried, percent correct", p$p[startsWith(p$test, "pairs by t of percent correct by ")], t.test(right[, 1], right[, 2], paired = TRUE)$p.value)
cat(figures, "figures of six designs,", faults, "faults\n")
quit(status = if (faults > 0) 1 else 0)
