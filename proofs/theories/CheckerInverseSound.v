(* SPDX-License-Identifier: LGPL-3.0-or-later *)
(* The intervals of CheckerInverse.v hold the values, where the functions are defined. *)
From Coq Require Import Reals Lra Lia ZArith Bool.
From Dyadel Require Import CheckerEnclosure CheckerEnclosureSound CheckerInverse.
Open Scope R_scope.

(* ---- real numbers ---- *)

Lemma logarithm_bounds e : 0 < e -> 1 - / e <= ln e <= e - 1.
Proof.
  assert (H : forall r, 0 < r -> ln r <= r - 1).
  { intros r P. pose proof (exp_ineq1_le (ln r)) as L. rewrite exp_ln in L by exact P. lra. }
  intros P. split; [| now apply H]. pose proof (H (/ e) (Rinv_0_lt_compat _ P)) as L. rewrite ln_Rinv in L by exact P.
  lra.
Qed.

Lemma logarithm_step r y : 0 < r -> ln r = y + ln (r * exp (- y)).
Proof. intros P. rewrite ln_mult, ln_exp by (trivial; apply exp_pos). ring. Qed.

Lemma arctangent_near r : Rabs (atan r - r) <= r * r.
Proof.
  assert (H : forall z, 0 < z -> z - z * z <= atan z <= z).
  { intros z P. destruct (MVT_cor2 atan (fun c => / (1 + c ^ 2)) 0 z P (fun c _ => derivable_pt_lim_atan c))
      as (c & E & C). rewrite atan_0 in E.
    assert (D : 0 < 1 + c ^ 2) by nra. assert (M : / (1 + c ^ 2) * (1 + c ^ 2) = 1) by (field; lra).
    set (i := / (1 + c ^ 2)) in *. assert (I0 : 0 < i) by (apply Rinv_0_lt_compat; exact D).
    assert (I1 : i <= 1) by nra. split; [| nra].
    assert (K : 1 - i <= z); [| nra].
    destruct (Rle_lt_dec 1 z); [lra |]. assert (c ^ 2 <= z) by nra. nra. }
  destruct (Rtotal_order r 0) as [N | [-> | P]].
  - pose proof (H (- r) ltac:(lra)) as K. rewrite atan_opp in K. rewrite Rabs_pos_eq; lra.
  - rewrite atan_0. unfold Rminus. rewrite Rplus_opp_r, Rabs_R0. lra.
  - pose proof (H r P). rewrite Rabs_left1; lra.
Qed.

Lemma arctangent_step x y : -2 <= y <= 2 -> 0 < cos y + x * sin y ->
  atan x = y + atan ((x * cos y - sin y) / (cos y + x * sin y)).
Proof.
  intros Y D. set (t := atan x). pose proof (atan_bound x) as B. fold t in B. pose proof PI2_3_2 as P.
  assert (K : 0 < cos t) by (apply cos_gt_0; lra).
  assert (T : sin t = x * cos t).
  { pose proof (tan_atan x) as T. fold t in T. unfold tan in T. rewrite <- T. field. lra. }
  assert (C : cos (t - y) = cos t * (cos y + x * sin y)) by (rewrite cos_minus, T; ring).
  assert (S : sin (t - y) = cos t * (x * cos y - sin y)) by (rewrite sin_minus, T; ring).
  assert (C0 : 0 < cos (t - y)) by (rewrite C; now apply Rmult_lt_0_compat).
  assert (Q : - (PI / 2) < t - y < PI / 2).
  { split; apply Rnot_le_lt; intros L; apply (Rlt_not_le _ _ C0).
    - rewrite <- cos_neg. apply cos_le_0; lra.
    - apply cos_le_0; lra. }
  replace ((x * cos y - sin y) / (cos y + x * sin y)) with (tan (t - y)).
  - rewrite atan_tan by exact Q. ring.
  - unfold tan. rewrite S, C. field. lra.
Qed.

Lemma arcsine_half x : -1 <= x <= 1 -> asin x = 2 * atan (x / (1 + sqrt (1 - x * x))).
Proof.
  intros X. set (t := asin x / 2). pose proof (asin_bound x) as B. pose proof PI_RGT_0 as P.
  assert (T : 2 * t = asin x) by (unfold t; field).
  assert (C : 0 < cos t) by (apply cos_gt_0; unfold t; lra).
  assert (S : 2 * sin t * cos t = x) by (rewrite <- sin_2a, T; now apply sin_asin).
  assert (Q : sqrt (1 - x * x) = 2 * cos t * cos t - 1) by (rewrite <- cos_2a_cos, T; symmetry; now apply cos_asin).
  rewrite Q. replace (x / (1 + (2 * cos t * cos t - 1))) with (tan t) by (rewrite <- S; unfold tan; field; split; nra).
  rewrite atan_tan by (unfold t; lra). unfold t. field.
Qed.

(* ---- intervals ---- *)

Section Sound.

Variable most : Z.
Variable root_hint : Z -> Z -> Z.

Lemma point_holds u y : (0 < u)%Z -> holds u (point y) (IZR y / IZR u).
Proof.
  intros U. apply IZR_lt in U. unfold holds, point. replace (IZR y / IZR u * IZR u) with (IZR y) by (field; lra). lra.
Qed.

Lemma settled_holds u f r n : (forall y, holds u (f y) r) -> forall y x, holds u x r -> holds u (settled n f y x) r.
Proof.
  intros H. induction n as [| n IH]; intros y x X; cbn [settled]; [exact X |]. pose proof (H y) as K.
  destruct (f y) as [[a b] |]; [| exact X]. destruct (is_narrower a b x); [now apply IH | exact X].
Qed.

Lemma finer_by_above u x : (0 < finer_by u x)%Z.
Proof. unfold finer_by, guard. lia. Qed.

Lemma logarithm_from_holds u x r y : (0 < u)%Z -> 0 < r -> holds u x r -> holds u (logarithm_from most u x y) (ln r).
Proof.
  intros U P H. unfold logarithm_from. cbv zeta. set (e := mul most u x (exponential most u (point (- y)))).
  pose proof (point_holds u (- y) U) as Y. rewrite opp_IZR in Y.
  assert (E : holds u e (r * exp (- IZR y / IZR u))) by (now apply mul_holds; trivial; apply exponential_holds).
  destruct (Z.eqb_spec (sign_of e) 1) as [S | S]; [| destruct (point y) as [[] |]; exact I].
  apply (sign_positive u U _ _ E) in S.
  rewrite (logarithm_step r (IZR y / IZR u) P).
  replace (- (IZR y / IZR u)) with (- IZR y / IZR u) by (unfold Rdiv; ring).
  set (z := r * exp (- IZR y / IZR u)) in *. apply add_holds; [now apply point_holds |].
  apply join_holds with (x := IZR 1 - / z) (y := z - IZR 1); trivial.
  - apply sub_holds; [now apply whole_holds | now apply inverse_holds].
  - apply sub_holds; [exact E | now apply whole_holds].
  - now apply logarithm_bounds.
Qed.

Lemma logarithm_holds u x r : (0 < u)%Z -> 0 < r -> holds u x r -> holds u (logarithm most u x) (ln r).
Proof.
  intros U P H. unfold logarithm. cbv zeta. pose proof (finer_by_above u x) as M. set (m := finer_by u x) in *.
  apply coarser_holds; [exact M |]. apply settled_holds; [| exact I]. intros y.
  apply logarithm_from_holds; [nia | exact P | now apply finer_holds].
Qed.

Lemma around_holds u x r z : holds u x (r * r) -> Rabs (z - r) <= r * r -> (0 < u)%Z -> holds u (around x) (z - r).
Proof.
  destruct x as [[a b] |]; [| intros; exact I]. simpl. intros [_ B] Z U. apply IZR_lt in U.
  rewrite opp_IZR. pose proof (Rle_abs (z - r)). pose proof (Rle_abs (- (z - r))) as N. rewrite Rabs_Ropp in N.
  split; nra.
Qed.

Lemma arctangent_from_holds u pi2 x r y : (0 < u)%Z -> holds u pi2 (PI / 2) -> holds u x r ->
  holds u (arctangent_from most u pi2 x y) (atan r).
Proof.
  intros U P H. unfold arctangent_from. cbv zeta. set (z := IZR y / IZR u).
  pose proof (point_holds u y U) as Y. fold z in Y.
  pose proof (cosine_holds most u _ _ U Y) as C. pose proof (sine_holds most u _ _ _ U P Y) as S.
  set (c := cosine most u (point y)) in *. set (s := sine most u pi2 (point y)) in *.
  set (d := add c (mul most u x s)).
  assert (D : holds u d (cos z + r * sin z)) by (apply add_holds; trivial; now apply mul_holds).
  destruct ((Z.abs y <=? 2 * u) && (sign_of d =? 1))%Z eqn:E; [| exact I]. apply andb_prop in E as [A B].
  apply Z.leb_le in A. apply Z.eqb_eq in B. apply (sign_positive u U _ _ D) in B.
  assert (A' : -2 <= z <= 2).
  { apply IZR_lt in U. assert (z * IZR u = IZR y) by (unfold z; field; lra).
    assert (L : (- (2 * u) <= y <= 2 * u)%Z) by lia. destruct L as [L1 L2]. apply IZR_le in L1, L2.
    rewrite opp_IZR, mult_IZR in *. split; apply Rmult_le_reg_r with (IZR u); lra. }
  rewrite (arctangent_step r z A' B). set (q := (r * cos z - sin z) / (cos z + r * sin z)).
  set (e := quotient most u (sub (mul most u x c) s) d).
  assert (Q : holds u e q) by (apply quotient_holds; trivial; apply sub_holds; trivial; now apply mul_holds).
  apply add_holds; trivial. replace (atan q) with (q + (atan q - q)) by ring. apply add_holds; trivial.
  apply around_holds; trivial; [now apply mul_holds | apply arctangent_near].
Qed.

Lemma arctangent_holds u pi2 x r : (0 < u)%Z -> holds u pi2 (PI / 2) -> holds u x r ->
  holds u (arctangent most u pi2 x) (atan r).
Proof.
  intros U P H. unfold arctangent. cbv zeta. pose proof (finer_by_above u x) as M. set (m := finer_by u x) in *.
  apply coarser_holds; [exact M |]. apply settled_holds; [| exact I]. intros y.
  apply arctangent_from_holds; [nia | now apply finer_holds ..].
Qed.

Lemma arcsine_holds u pi2 x r : (0 < u)%Z -> holds u pi2 (PI / 2) -> -1 <= r <= 1 -> holds u x r ->
  holds u (arcsine most root_hint u pi2 x) (asin r).
Proof.
  intros U P B H. unfold arcsine. cbv zeta. rewrite (arcsine_half r B).
  replace (2 * atan (r / (1 + sqrt (1 - r * r)))) with
    (atan (r / (IZR 1 + sqrt (IZR 1 - r * r))) + atan (r / (IZR 1 + sqrt (IZR 1 - r * r)))) by ring.
  pose proof (whole_holds u 1) as O.
  assert (C : holds u (square_root root_hint u (sub (whole u 1) (mul most u x x))) (sqrt (IZR 1 - r * r))).
  { apply square_root_holds; [exact U | apply sub_holds; [exact O | now apply mul_holds] |]. simpl. nra. }
  apply add_holds; (apply arctangent_holds; trivial; apply quotient_holds; trivial; now apply add_holds).
Qed.

(* What the function is, and where it is defined. *)
Definition inverse_at (f : inverse_function) : R -> R :=
  match f with Logarithm => ln | Arcsine => asin | Arccosine => acos | Arctangent => atan end.
Definition inverse_defined (f : inverse_function) (x : R) : Prop :=
  match f with Logarithm => 0 < x | Arcsine | Arccosine => -1 <= x <= 1 | Arctangent => True end.

Theorem inverse_value_holds u pi2 f x r : (0 < u)%Z -> holds u pi2 (PI / 2) -> inverse_defined f r -> holds u x r ->
  holds u (inverse_value most root_hint u pi2 f x) (inverse_at f r).
Proof.
  intros U P D H. destruct f; cbn [inverse_value inverse_at inverse_defined] in *.
  - now apply logarithm_holds.
  - now apply arcsine_holds.
  - rewrite (acos_asin r D). apply sub_holds; trivial. now apply arcsine_holds.
  - now apply arctangent_holds.
Qed.

End Sound.
