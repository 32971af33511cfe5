# Reference values for tests/analysis/stats, from R. Run in this folder: Rscript reference.R
# Writes reference.csv (name, value) and versions.txt.
suppressPackageStartupMessages({library(coin); library(lme4); library(MASS); library(ordinal)})

out <- data.frame(name = character(), value = numeric())
put <- function(name, value) {
  out[nrow(out) + 1, ] <<- list(name, as.numeric(value))
}

laps <- read.csv("laps.csv")
wide <- reshape(laps[, c("participant", "condition", "lap_time_s")], idvar = "participant",
                timevar = "condition", direction = "wide")
baseline <- wide$lap_time_s.baseline
limited <- wide$lap_time_s.limited
human <- wide$lap_time_s.human
model <- wide$lap_time_s.model
item <- read.csv("item.csv")

# Wilcoxon signed-rank: without ties (base R, with interval), with ties and zeros (coin).
w <- wilcox.test(model, human, paired = TRUE, exact = TRUE, conf.int = TRUE)
put("signed_rank.statistic", w$statistic)
put("signed_rank.p", w$p.value)
put("signed_rank.estimate", w$estimate)
put("signed_rank.low", w$conf.int[1])
put("signed_rank.high", w$conf.int[2])
for (zeros in c("Pratt", "Wilcoxon")) {
  e <- wilcoxsign_test(condition ~ reference, data = item, distribution = "exact",
                       zero.method = zeros)
  put(paste0("signed_rank.", tolower(zeros), ".exact_p"), pvalue(e))
  a <- wilcoxsign_test(condition ~ reference, data = item, distribution = "asymptotic",
                       zero.method = zeros)
  put(paste0("signed_rank.", tolower(zeros), ".asymptotic_p"), pvalue(a))
}

# Kolmogorov-Smirnov: without ties, with ties (exact, conditional on them), asymptotic.
k <- ks.test(human, model, exact = TRUE)
put("ks.statistic", k$statistic)
put("ks.exact_p", k$p.value)
put("ks.asymptotic_p", suppressWarnings(ks.test(human, model, exact = FALSE))$p.value)
k <- suppressWarnings(ks.test(item$reference, item$condition, exact = TRUE))
put("ks.ties.statistic", k$statistic)
put("ks.ties.exact_p", k$p.value)

# Holm.
p <- c(0.01, 0.04, 0.03, 0.005, 0.2)
for (i in seq_along(p)) put(paste0("holm.", i), p.adjust(p, "holm")[i])

# Mean difference, d_z, rank-biserial written out.
d <- model - human
t <- t.test(model, human, paired = TRUE)
put("mean_difference.estimate", t$estimate)
put("mean_difference.low", t$conf.int[1])
put("mean_difference.high", t$conf.int[2])
put("mean_difference.statistic", t$statistic)
put("mean_difference.p", t$p.value)
put("d_z", mean(d) / sd(d))
r <- rank(abs(d))
put("rank_biserial", (sum(r[d > 0]) - sum(r[d < 0])) / sum(r))

# Ratio of means: Fieller's interval, found as the ratios that a paired t-test does not reject.
put("ratio_of_means", mean(limited) / mean(model))
reject <- function(r) t.test(limited - r * model)$p.value - 0.05
at <- mean(limited) / mean(model)
put("ratio_of_means.low", uniroot(reject, c(at / 2, at - 1e-9), tol = 1e-12)$root)
put("ratio_of_means.high", uniroot(reject, c(at + 1e-9, at * 2), tol = 1e-12)$root)
r <- t.test(limited / model)
put("mean_of_ratios", r$estimate)
put("mean_of_ratios.low", r$conf.int[1])
put("mean_of_ratios.high", r$conf.int[2])

# TOST written out: two one-sided paired t-tests, margin 10 s.
lower <- t.test(d, mu = -10, alternative = "greater")
upper <- t.test(d, mu = 10, alternative = "less")
put("tost.p", max(lower$p.value, upper$p.value))
put("tost.statistic", min(lower$statistic, -upper$statistic))
ci <- t.test(d, conf.level = 0.9)$conf.int
put("tost.low", ci[1])
put("tost.high", ci[2])

# Mixed model of log lap time: fixed order (lap not identified), turned order (lap identified).
laps$condition <- factor(laps$condition, levels = c("limited", "baseline", "human", "model"))
m <- lmer(log(lap_time_s) ~ condition + (1 | participant), data = laps, REML = TRUE)
for (c in c("baseline", "human", "model")) {
  put(paste0("lmer.", c), fixef(m)[paste0("condition", c)])
  put(paste0("lmer.", c, ".se"), sqrt(diag(as.matrix(vcov(m))))[paste0("condition", c)])
}
put("lmer.sd_participant", attr(VarCorr(m)$participant, "stddev"))
put("lmer.sd_residual", sigma(m))
turned <- read.csv("laps_turned.csv")
turned$condition <- factor(turned$condition, levels = c("limited", "baseline", "human", "model"))
turned$place <- turned$lap - mean(turned$lap)
m <- lmer(log(lap_time_s) ~ condition + place + (1 | participant), data = turned, REML = TRUE)
for (c in c("baseline", "human", "model")) {
  put(paste0("lmer.turned.", c), fixef(m)[paste0("condition", c)])
  put(paste0("lmer.turned.", c, ".se"), sqrt(diag(as.matrix(vcov(m))))[paste0("condition", c)])
}
# In complete data the mixed model's t test is the repeated-measures analysis of variance's.
f <- summary(aov(log(lap_time_s) ~ condition + Error(participant), data = laps))
put("aov.df_within", f[["Error: Within"]][[1]]["Residuals", "Df"])

# Proportional odds, by two packages.
long <- data.frame(answer = factor(c(item$reference, item$condition), ordered = TRUE),
                   after = rep(0:1, each = nrow(item)))
put("polr", coef(polr(answer ~ after, data = long, method = "logistic")))
put("clm", clm(answer ~ after, data = long, link = "logit")$beta)

# Cronbach's alpha written out, with Feldt's interval.
s <- read.csv("scale.csv")
n <- nrow(s)
j <- ncol(s)
alpha <- j / (j - 1) * (1 - sum(diag(cov(s))) / sum(cov(s)))
put("alpha", alpha)
put("alpha.low", 1 - (1 - alpha) * qf(0.975, n - 1, (n - 1) * (j - 1)))
put("alpha.high", 1 - (1 - alpha) * qf(0.025, n - 1, (n - 1) * (j - 1)))

out$value <- sprintf("%.15g", out$value)
write.csv(out, "reference.csv", row.names = FALSE, quote = FALSE)
packages <- c("coin", "lme4", "MASS", "ordinal", "stats")
versions <- sapply(packages, function(x) as.character(packageVersion(x)))
writeLines(c(R.version.string, paste(packages, versions)), "versions.txt")
