(* SPDX-License-Identifier: LGPL-3.0-or-later *)
(* The point deepest inside half-planes: three of them prove that it is [LP-1]. *)
From Coq Require Import Reals Lra Lia Psatz Classical.
From Dyadel Require Import Plane.
Open Scope R_scope.

(* The half-plane a x + b y + c > 0, with its weight w > 0; its depth at a point. *)
Record plane : Type := Half { na : R; nb : R; nc : R; weight : R }.
Definition form (h : plane) (p : point) : R := na h * fst p + nb h * snd p + nc h.
Definition depth (h : plane) (p : point) : R := form h p / weight h.
Definition good (h : plane) : Prop := 0 < weight h.
Definition minor (h g : plane) : R := na h * nb g - nb h * na g.

(* Factors, none negative and not all 0, with which the normals of three cancel. *)
Definition balanced (f g h : plane) (k l m : R) : Prop :=
  0 <= k /\ 0 <= l /\ 0 <= m /\ 0 < k + l + m /\
  k * na f + l * na g + m * na h = 0 /\ k * nb f + l * nb g + m * nb h = 0.
Definition value (f g h : plane) (k l m : R) : R :=
  (k * nc f + l * nc g + m * nc h) / (k * weight f + l * weight g + m * weight h).

Lemma weights_pos f g h k l m : good f -> good g -> good h -> balanced f g h k l m ->
  0 < k * weight f + l * weight g + m * weight h.
Proof.
  unfold good. intros F G H [K [L [M [S _]]]].
  assert (0 <= k * weight f) by (apply Rmult_le_pos; lra). assert (0 <= l * weight g) by (apply Rmult_le_pos; lra).
  assert (0 <= m * weight h) by (apply Rmult_le_pos; lra).
  destruct (Rle_lt_or_eq_dec 0 k K) as [P | <-]; [assert (0 < k * weight f) by (apply Rmult_lt_0_compat; lra); lra |].
  destruct (Rle_lt_or_eq_dec 0 l L) as [P | <-]; [assert (0 < l * weight g) by (apply Rmult_lt_0_compat; lra); lra |].
  assert (0 < m * weight h) by (apply Rmult_lt_0_compat; lra). lra.
Qed.

Lemma depth_form h p : good h -> form h p = depth h p * weight h.
Proof. unfold good, depth. intros H. field. lra. Qed.

Lemma balanced_sum f g h k l m p : balanced f g h k l m ->
  k * form f p + l * form g p + m * form h p = k * nc f + l * nc g + m * nc h.
Proof.
  intros [_ [_ [_ [_ [X Y]]]]]. unfold form.
  replace (k * (na f * fst p + nb f * snd p + nc f) + l * (na g * fst p + nb g * snd p + nc g) +
    m * (na h * fst p + nb h * snd p + nc h)) with ((k * na f + l * na g + m * na h) * fst p +
    (k * nb f + l * nb g + m * nb h) * snd p + (k * nc f + l * nc g + m * nc h)) by ring.
  rewrite X, Y. ring.
Qed.

(* Wherever three are all at least v deep, v is at most their value; *)
Theorem triple_bounds f g h k l m p v : good f -> good g -> good h -> balanced f g h k l m ->
  v <= depth f p -> v <= depth g p -> v <= depth h p -> v <= value f g h k l m.
Proof.
  intros F G H Q Df Dg Dh. pose proof (weights_pos f g h k l m F G H Q) as W. pose proof (balanced_sum f g h k l m p Q) as S.
  rewrite (depth_form f p F), (depth_form g p G), (depth_form h p H) in S. destruct Q as [K [L [M _]]]. unfold good in *.
  apply (Rmult_le_reg_r (k * weight f + l * weight g + m * weight h)); [exact W |].
  unfold value, Rdiv. rewrite Rmult_assoc, Rinv_l, Rmult_1_r by lra. rewrite <- S.
  assert (T : forall x w d, 0 <= x -> 0 < w -> v <= d -> x * w * v <= x * (d * w)).
  { intros x w d X Hw D. assert (0 <= x * w) by (apply Rmult_le_pos; lra).
    replace (x * (d * w)) with (x * w * d) by ring. apply Rmult_le_compat_l; lra. }
  pose proof (T k _ _ K F Df). pose proof (T l _ _ L G Dg). pose proof (T m _ _ M H Dh). lra.
Qed.

(* where they are equally deep, they are as deep as that. *)
Theorem triple_attains f g h k l m p v : good f -> good g -> good h -> balanced f g h k l m ->
  depth f p = v -> depth g p = v -> depth h p = v -> value f g h k l m = v.
Proof.
  intros F G H Q Df Dg Dh. pose proof (weights_pos f g h k l m F G H Q) as W. pose proof (balanced_sum f g h k l m p Q) as S.
  rewrite (depth_form f p F), (depth_form g p G), (depth_form h p H), Df, Dg, Dh in S.
  unfold value. rewrite <- S. field. lra.
Qed.

(* So a place where three balanced ones are equally deep, and no other of the half-planes less, is deepest; *)
Theorem triple_optimal (all : plane -> Prop) f g h k l m p v : (forall e, all e -> good e) -> all f -> all g -> all h ->
  balanced f g h k l m -> depth f p = v -> depth g p = v -> depth h p = v -> (forall e, all e -> v <= depth e p) ->
  value f g h k l m = v /\ forall q u, (forall e, all e -> u <= depth e q) -> u <= v.
Proof.
  intros A F G H Q Df Dg Dh L. pose proof (triple_attains f g h k l m p v (A f F) (A g G) (A h H) Q Df Dg Dh) as E.
  split; [exact E |]. intros q u U. rewrite <- E. apply (triple_bounds f g h k l m q); auto.
Qed.

(* and its depth is positive iff the open half-planes have a common point. *)
Theorem common_point (all : plane -> Prop) f g h k l m p v : (forall e, all e -> good e) -> all f -> all g -> all h ->
  balanced f g h k l m -> depth f p = v -> depth g p = v -> depth h p = v -> (forall e, all e -> v <= depth e p) ->
  (v <= 0 <-> ~ exists q, forall e, all e -> 0 < form e q).
Proof.
  intros A F G H Q Df Dg Dh L. split.
  - intros V [q C].
    assert (Pos : forall e, all e -> 0 < depth e q) by (intros e Ae; apply Rdiv_lt_0_compat; [now apply C | now apply A]).
    pose proof (Pos f F). pose proof (Pos g G). pose proof (Pos h H).
    set (u := Rmin (depth f q) (Rmin (depth g q) (depth h q))).
    assert (U : 0 < u) by (unfold u; repeat apply Rmin_glb_lt; lra).
    assert (u <= value f g h k l m).
    { apply (triple_bounds f g h k l m q); auto; unfold u; pose proof (Rmin_l (depth f q) (Rmin (depth g q) (depth h q)));
        pose proof (Rmin_r (depth f q) (Rmin (depth g q) (depth h q)));
        pose proof (Rmin_l (depth g q) (depth h q)); pose proof (Rmin_r (depth g q) (depth h q)); lra. }
    rewrite (triple_attains f g h k l m p v) in *; auto. lra.
  - intros N. apply Rnot_lt_le. intros V. apply N. exists p. intros e Ae. rewrite (depth_form e p (A e Ae)).
    apply Rmult_lt_0_compat; [pose proof (L e Ae); lra | now apply A].
Qed.

(* The minors of the normals are such factors when they have one sign. *)
Theorem minors_balance f g h : 0 <= minor g h -> 0 <= minor h f -> 0 <= minor f g -> 0 < minor g h + minor h f + minor f g ->
  balanced f g h (minor g h) (minor h f) (minor f g).
Proof. intros K L M S. unfold balanced, minor in *. repeat split; try assumption; ring. Qed.

(* A further half-plane takes the place of one of three. *)
Lemma two_balance a b e s t : 0 <= s -> 0 <= t -> 0 < s + t -> s * na a + t * na b = 0 -> s * nb a + t * nb b = 0 ->
  balanced a b e s t 0.
Proof. intros. unfold balanced. repeat split; lra. Qed.

Lemma balanced_swap a b c x y z : balanced a b c x y z -> balanced a c b x z y.
Proof. unfold balanced. intros [A0 [A1 [A2 [A3 [A4 A5]]]]]. repeat split; lra. Qed.

Lemma balanced_turn a b c x y z : balanced a b c x y z -> balanced c a b z x y.
Proof. unfold balanced. intros [A0 [A1 [A2 [A3 [A4 A5]]]]]. repeat split; lra. Qed.

Lemma parallel_to f g : (na f <> 0 \/ nb f <> 0) -> minor f g = 0 -> exists s, na g = s * na f /\ nb g = s * nb f.
Proof.
  unfold minor. intros F M. assert (P : na f * na f + nb f * nb f <> 0).
  { pose proof (Rle_0_sqr (na f)) as A. pose proof (Rle_0_sqr (nb f)) as C. unfold Rsqr in A, C. intros Z.
    destruct (Rplus_sqr_eq_0 (na f) (nb f)); [unfold Rsqr; lra |]. tauto. }
  exists ((na f * na g + nb f * nb g) / (na f * na f + nb f * nb f)).
  split; apply (Rmult_eq_reg_r (na f * na f + nb f * nb f)); try exact P.
  - transitivity ((na f * na g + nb f * nb g) * na f); [| field; exact P].
    apply Rminus_diag_uniq. transitivity (- nb f * (na f * nb g - nb f * na g)); [ring | rewrite M; ring].
  - transitivity ((na f * na g + nb f * nb g) * nb f); [| field; exact P].
    apply Rminus_diag_uniq. transitivity (na f * (na f * nb g - nb f * na g)); [ring | rewrite M; ring].
Qed.

(* The least of three quotients. *)
Lemma least_quotient a b c k l m : 0 < k -> 0 < l -> 0 < m -> exists u,
  0 <= a - u * k /\ 0 <= b - u * l /\ 0 <= c - u * m /\ (a - u * k = 0 \/ b - u * l = 0 \/ c - u * m = 0).
Proof.
  intros K L M. set (u := Rmin (a / k) (Rmin (b / l) (c / m))). exists u.
  assert (Ek : a / k * k = a) by (field; lra). assert (El : b / l * l = b) by (field; lra).
  assert (Em : c / m * m = c) by (field; lra).
  assert (Ua : u <= a / k) by apply Rmin_l.
  assert (Ub : u <= b / l) by (apply Rle_trans with (1 := Rmin_r _ _); apply Rmin_l).
  assert (Uc : u <= c / m) by (apply Rle_trans with (1 := Rmin_r _ _); apply Rmin_r).
  split; [nra |]. split; [nra |]. split; [nra |].
  unfold u. apply Rmin_case; [left; lra |]. apply Rmin_case; [right; left; lra | right; right; lra].
Qed.

Theorem exchange f g h e k l m : balanced f g h k l m -> (na f <> 0 \/ nb f <> 0) ->
  (exists x y z, balanced e g h x y z) \/ (exists x y z, balanced f e h x y z) \/ (exists x y z, balanced f g e x y z).
Proof.
  intros [K [L [M [S [X Y]]]]] Nf.
  destruct (Rle_lt_or_eq_dec 0 m M) as [M0 | <-]; [| right; right; exists k, l, 0; apply two_balance; lra].
  destruct (Rle_lt_or_eq_dec 0 l L) as [L0 | <-];
    [| right; left; exists k, 0, m; apply balanced_swap, two_balance; lra].
  destruct (Rle_lt_or_eq_dec 0 k K) as [K0 | <-];
    [| left; exists 0, l, m; apply balanced_turn, two_balance; lra].
  destruct (Req_dec (minor f g) 0) as [D | D].
  - (* all are parallel, and one of the two others is opposite to the first *)
    assert (Dh : minor f h = 0).
    { apply (Rmult_eq_reg_l m); [| lra]. rewrite Rmult_0_r. unfold minor in *.
      transitivity (na f * (k * nb f + l * nb g + m * nb h) - nb f * (k * na f + l * na g + m * na h) -
        l * (na f * nb g - nb f * na g)); [ring |]. rewrite X, Y, D. ring. }
    destruct (parallel_to f g Nf D) as [s [G1 G2]]. destruct (parallel_to f h Nf Dh) as [t [H1 H2]].
    assert (Z : k + l * s + m * t = 0).
    { rewrite G1, H1 in X. rewrite G2, H2 in Y.
      assert (P : (k + l * s + m * t) * na f = 0) by lra. assert (Q : (k + l * s + m * t) * nb f = 0) by lra.
      destruct Nf as [Z | Z]; [apply Rmult_integral in P | apply Rmult_integral in Q]; tauto. }
    destruct (Rlt_dec s 0) as [Ns | Ps].
    + right. right. exists (- s), 1, 0. apply two_balance; try lra; rewrite ?G1, ?G2; ring.
    + assert (t < 0).
      { apply Rnot_le_lt. intros Pt. assert (0 <= l * s) by (apply Rmult_le_pos; lra).
        assert (0 <= m * t) by (apply Rmult_le_pos; lra). lra. }
      right. left. exists (- t), 0, 1. apply balanced_swap, two_balance; try lra; rewrite ?H1, ?H2; ring.
  - set (a := - minor e g / minor f g). set (b := - minor f e / minor f g).
    assert (E1 : a * na f + b * na g = - na e) by (unfold a, b, minor in *; field; exact D).
    assert (E2 : a * nb f + b * nb g = - nb e) by (unfold a, b, minor in *; field; exact D).
    destruct (least_quotient a b 0 k l m K0 L0 M0) as [u [A [C [W Z]]]].
    set (x := a - u * k) in *. set (y := b - u * l) in *. set (z := 0 - u * m) in *.
    assert (F1 : x * na f + y * na g + z * na h + na e = 0).
    { transitivity (a * na f + b * na g + na e - u * (k * na f + l * na g + m * na h)); [unfold x, y, z; ring |].
      rewrite E1, X. ring. }
    assert (F2 : x * nb f + y * nb g + z * nb h + nb e = 0).
    { transitivity (a * nb f + b * nb g + nb e - u * (k * nb f + l * nb g + m * nb h)); [unfold x, y, z; ring |].
      rewrite E2, Y. ring. }
    destruct Z as [Z | [Z | Z]]; rewrite Z in F1, F2.
    + left. exists 1, y, z. unfold balanced. repeat split; lra.
    + right. left. exists x, 1, z. unfold balanced. repeat split; lra.
    + right. right. exists x, y, 1. unfold balanced. repeat split; lra.
Qed.
