(* SPDX-License-Identifier: LGPL-3.0-or-later *)
(* Ten directions decide whether the hulls of two pairs of rectangles are disjoint [HULL-1]. *)
From Coq Require Import Reals Lra Lia Psatz Classical List.
From Dyadel Require Import Plane Distance Nerve Crossing.
Import ListNotations.
Open Scope R_scope.

(* ---- a direction in which all of finitely many vectors go, or three that cancel ---- *)

Definition wedge (a b : point) : R := fst a * snd b - snd a * fst b.
Definition sum2 (s : R) (a : point) (t : R) (b : point) : point := (s * fst a + t * fst b, s * snd a + t * snd b).

Definition cancel (l : list point) : Prop := exists a b c r s t, In a l /\ In b l /\ In c l /\
  0 <= r /\ 0 <= s /\ 0 <= t /\ 0 < r + s + t /\
  r * fst a + s * fst b + t * fst c = 0 /\ r * snd a + s * snd b + t * snd c = 0.

(* All are between two of them. *)
Definition spread (l : list point) : Prop := exists a b n, In a l /\ In b l /\ 0 < dot n a /\ 0 < dot n b /\
  forall d, In d l -> exists s t, 0 <= s /\ 0 <= t /\ 0 < s + t /\ d = sum2 s a t b.

Lemma both_ahead a b : wedge a b <> 0 -> exists n, dot n a = 1 /\ dot n b = 1.
Proof.
  intros W. exists ((snd b - snd a) / wedge a b, (fst a - fst b) / wedge a b). unfold dot. simpl.
  split; apply (Rmult_eq_reg_r (wedge a b)); try exact W; field_simplify; try exact W; unfold wedge; ring.
Qed.

Lemma sum2_split a b d : wedge a b <> 0 -> d = sum2 (wedge d b / wedge a b) a (wedge a d / wedge a b) b.
Proof.
  intros W. rewrite (surjective_pairing d) at 1. unfold sum2. f_equal; apply (Rmult_eq_reg_r (wedge a b)); try exact W;
    field_simplify; try exact W; unfold wedge; ring.
Qed.

Lemma on_ray a b n : 0 < dot n a -> wedge a b = 0 -> b = sum2 (dot n b / dot n a) a 0 a.
Proof.
  intros A W. assert (X : fst b * dot n a = dot n b * fst a).
  { apply Rminus_diag_uniq. transitivity (- snd n * wedge a b); [unfold dot, wedge; ring | rewrite W; ring]. }
  assert (Y : snd b * dot n a = dot n b * snd a).
  { apply Rminus_diag_uniq. transitivity (fst n * wedge a b); [unfold dot, wedge; ring | rewrite W; ring]. }
  rewrite (surjective_pairing b) at 1. unfold sum2. f_equal; apply (Rmult_eq_reg_r (dot n a)); try lra.
  - rewrite X. field. lra.
  - rewrite Y. field. lra.
Qed.

Lemma spread_or_cancel l : l <> [] -> spread l \/ cancel l.
Proof.
  induction l as [| d l IH]; [congruence |]. intros _.
  destruct (classic (d = (0, 0))) as [-> | D0].
  { right. exists (0, 0), (0, 0), (0, 0), 1, 0, 0. simpl. repeat split; auto; lra. }
  destruct l as [| e l'].
  { left. exists d, d, d. assert (P : 0 < dot d d).
    { destruct d as [x y]. unfold dot. simpl. destruct (Req_dec x 0) as [-> | X]; [| nra].
      destruct (Req_dec y 0) as [-> | Y]; [now elim D0 | nra]. }
    simpl. repeat split; auto. intros e [<- | []]. exists 1, 0. repeat split; try lra.
    destruct d. unfold sum2. simpl. f_equal; ring. }
  destruct IH as [[a [b [n [Ia [Ib [Na [Nb All]]]]]]] | [a [b [c [r [s [t [A [B [C H]]]]]]]]]]; [congruence | |].
  2: { right. exists a, b, c, r, s, t. split; [now right |]. split; [now right |]. split; [now right | exact H]. }
  set (m := e :: l') in *. destruct (Req_dec (wedge a b) 0) as [W | W].
  - (* all so far go the same way *)
    pose proof (on_ray a b n Na W) as Eb. set (k := dot n b / dot n a) in *.
    assert (K : 0 < k) by (unfold k; apply Rdiv_lt_0_compat; lra).
    assert (Ray : forall f, In f m -> exists s, 0 < s /\ f = sum2 s a 0 a).
    { intros f F. destruct (All f F) as [s [t [S [T [P ->]]]]]. exists (s + t * k). split; [nra |].
      unfold sum2 in *. rewrite Eb. simpl. f_equal; ring. }
    destruct (Req_dec (wedge a d) 0) as [V | V].
    + pose proof (on_ray a d n Na V) as Ed. set (q := dot n d / dot n a) in *. destruct (Rlt_dec 0 q) as [Q | Q].
      * left. exists a, b, n. split; [now right |]. split; [now right |]. split; [exact Na |]. split; [exact Nb |].
        intros f [<- | F]; [| now apply All]. exists q, 0. split; [lra |]. split; [lra |]. split; [lra |].
        rewrite Ed. unfold sum2. f_equal; ring.
      * right. exists d, a, a, 1, (- q), 0. split; [now left |]. split; [now right |]. split; [now right |].
        pose proof (f_equal fst Ed) as E1. pose proof (f_equal snd Ed) as E2. simpl in E1, E2. repeat split; lra.
    + left. destruct (both_ahead a d V) as [u [Ua Ud]]. exists a, d, u. split; [now right |]. split; [now left |].
      split; [lra |]. split; [lra |]. intros f [<- | F].
      * exists 0, 1. repeat split; try lra. destruct d. unfold sum2. simpl. f_equal; ring.
      * destruct (Ray f F) as [s [S ->]]. exists s, 0. repeat split; try lra. unfold sum2. f_equal; ring.
  - pose proof (sum2_split a b d W) as E. set (s := wedge d b / wedge a b) in *. set (t := wedge a d / wedge a b) in *.
    pose proof (f_equal fst E) as E1. pose proof (f_equal snd E) as E2. simpl in E1, E2.
    assert (Ws : wedge d b = s * wedge a b) by (unfold s; field; exact W).
    assert (Wt : wedge a d = t * wedge a b) by (unfold t; field; exact W).
    assert (Nz : s <> 0 \/ t <> 0).
    { apply NNPP. intros N. apply not_or_and in N as [N1 N2]. apply NNPP in N1, N2. apply D0. rewrite N1, N2 in *.
      destruct d. simpl in *. f_equal; lra. }
    destruct (Rle_dec 0 s) as [S | S]; destruct (Rle_dec 0 t) as [T | T].
    + left. exists a, b, n. split; [now right |]. split; [now right |]. split; [exact Na |]. split; [exact Nb |].
      intros f [<- | F]; [| now apply All]. exists s, t. repeat split; auto. destruct Nz; lra.
    + destruct (Req_dec s 0) as [Z | Z].
      * right. exists d, b, b, 1, (- t), 0. split; [now left |]. split; [now right |]. split; [now right |].
        rewrite Z in *. repeat split; lra.
      * left. assert (V : wedge d b <> 0) by (rewrite Ws; now apply Rmult_integral_contrapositive).
        destruct (both_ahead d b V) as [u [Ud Ub]]. exists d, b, u. split; [now left |]. split; [now right |].
        split; [lra |]. split; [lra |]. assert (I : 0 < / s) by (apply Rinv_0_lt_compat; lra). intros f [<- | F].
        -- exists 1, 0. repeat split; try lra. destruct d. unfold sum2. simpl. f_equal; ring.
        -- destruct (All f F) as [x [y [X [Y [P ->]]]]]. exists (x * / s), (y + x * / s * - t).
           assert (0 <= x * / s) by (apply Rmult_le_pos; lra). assert (0 <= x * / s * - t) by (apply Rmult_le_pos; lra).
           repeat split; try lra.
           ++ destruct (Req_dec x 0) as [-> | Xn]; [lra |]. assert (0 < x * / s) by (apply Rmult_lt_0_compat; lra). lra.
           ++ unfold sum2. rewrite E1, E2. f_equal; field; lra.
    + destruct (Req_dec t 0) as [Z | Z].
      * right. exists d, a, a, 1, (- s), 0. split; [now left |]. split; [now right |]. split; [now right |].
        rewrite Z in *. repeat split; lra.
      * left. assert (V : wedge a d <> 0) by (rewrite Wt; now apply Rmult_integral_contrapositive).
        destruct (both_ahead a d V) as [u [Ua Ud]]. exists a, d, u. split; [now right |]. split; [now left |].
        split; [lra |]. split; [lra |]. assert (I : 0 < / t) by (apply Rinv_0_lt_compat; lra). intros f [<- | F].
        -- exists 0, 1. repeat split; try lra. destruct d. unfold sum2. simpl. f_equal; ring.
        -- destruct (All f F) as [x [y [X [Y [P ->]]]]]. exists (x + y * / t * - s), (y * / t).
           assert (0 <= y * / t) by (apply Rmult_le_pos; lra). assert (0 <= y * / t * - s) by (apply Rmult_le_pos; lra).
           repeat split; try lra.
           ++ destruct (Req_dec y 0) as [-> | Yn]; [lra |]. assert (0 < y * / t) by (apply Rmult_lt_0_compat; lra). lra.
           ++ unfold sum2. rewrite E1, E2. f_equal; field; lra.
    + right. exists d, a, b, 1, (- s), (- t). split; [now left |]. split; [now right |]. split; [now right |].
      repeat split; lra.
Qed.

Theorem ahead_or_cancel l : (exists n, forall d, In d l -> 0 < dot n d) \/ cancel l.
Proof.
  destruct l as [| e l']; [left; now exists (0, 0) |].
    destruct (spread_or_cancel (e :: l')) as [H | H]; [congruence | | now right].
  left. destruct H as [a [b [n [_ [_ [A [B All]]]]]]]. exists n. intros d D.
    destruct (All d D) as [s [t [S [T [P ->]]]]].
  assert (E : dot n (sum2 s a t b) = s * dot n a + t * dot n b) by (unfold dot, sum2; simpl; ring). rewrite E.
  assert (0 <= s * dot n a) by (apply Rmult_le_pos; lra). assert (0 <= t * dot n b) by (apply Rmult_le_pos; lra).
  destruct (Req_dec s 0) as [-> | S0]; [assert (0 < t * dot n b) by (apply Rmult_lt_0_compat; lra); lra |].
  assert (0 < s * dot n a) by (apply Rmult_lt_0_compat; lra). lra.
Qed.

(* ---- the hull of two rectangles ---- *)

Lemma edge_convex X Y z w t : partial_edge X Y z -> partial_edge X Y w -> 0 <= t <= 1 -> partial_edge X Y (mix t z w).
Proof.
  intros [x [y [Ix [Iy [s [S ->]]]]]] [x' [y' [Ix' [Iy' [s' [S' ->]]]]]] T.
  set (q := (1 - t) * s + t * s').
  assert (Qa : 0 <= (1 - t) * s) by (apply Rmult_le_pos; lra). assert (Qb : 0 <= t * s') by (apply Rmult_le_pos; lra).
  assert (Ra : 0 <= (1 - t) * (1 - s)) by (apply Rmult_le_pos; lra).
  assert (Rb : 0 <= t * (1 - s')) by (apply Rmult_le_pos; lra).
  assert (Ex : exists u, inside u X /\ forall f : point -> R, (forall k a b, f (mix k a b) = (1 - k) * f a + k * f b) ->
    (1 - q) * f u = (1 - t) * (1 - s) * f x + t * (1 - s') * f x').
  { destruct (Req_dec q 1) as [Q | Q].
    - exists x. split; [exact Ix |]. intros f _. assert (Z1 : (1 - t) * (1 - s) = 0) by (unfold q in Q; lra).
      assert (Z2 : t * (1 - s') = 0) by (unfold q in Q; lra). rewrite Q, Z1, Z2. ring.
    - set (k := t * (1 - s') / (1 - q)). assert (P : 0 < 1 - q) by (unfold q in *; lra).
      exists (mix k x x'). split.
      + apply inside_convex; [| exact Ix | exact Ix']. unfold k. split.
        * apply Rmult_le_pos; [exact Rb | left; now apply Rinv_0_lt_compat].
        * apply (Rmult_le_reg_r (1 - q)); [exact P |]. unfold Rdiv. rewrite Rmult_assoc, Rinv_l by lra. unfold q. lra.
      + intros f F. rewrite F. unfold k. field_simplify; [| lra]. unfold q. ring. }
  assert (Ey : exists u, inside u Y /\ forall f : point -> R, (forall k a b, f (mix k a b) = (1 - k) * f a + k * f b) ->
    q * f u = (1 - t) * s * f y + t * s' * f y').
  { destruct (Req_dec q 0) as [Q | Q].
    - exists y. split; [exact Iy |]. intros f _. assert (Z1 : (1 - t) * s = 0) by (unfold q in Q; lra).
      assert (Z2 : t * s' = 0) by (unfold q in Q; lra). rewrite Q, Z1, Z2. ring.
    - set (k := t * s' / q). assert (P : 0 < q) by (unfold q in *; lra).
      exists (mix k y y'). split.
      + apply inside_convex; [| exact Iy | exact Iy']. unfold k. split.
        * apply Rmult_le_pos; [exact Qb | left; now apply Rinv_0_lt_compat].
        * apply (Rmult_le_reg_r q); [exact P |]. unfold Rdiv. rewrite Rmult_assoc, Rinv_l by lra. unfold q. lra.
      + intros f F. rewrite F. unfold k. field_simplify; [| lra]. unfold q. ring. }
  destruct Ex as [u [U Eu]]. destruct Ey as [v [V Ev]].
  exists u, v. split; [exact U |]. split; [exact V |]. exists q. split; [unfold q; lra |].
  assert (Af : forall k a b, fst (mix k a b) = (1 - k) * fst a + k * fst b) by reflexivity.
  assert (As : forall k a b, snd (mix k a b) = (1 - k) * snd a + k * snd b) by reflexivity.
  pose proof (Eu fst Af). pose proof (Eu snd As). pose proof (Ev fst Af). pose proof (Ev snd As).
  unfold mix at 1 4. simpl. f_equal; lra.
Qed.

Lemma edge_three X Y a b c r s t : partial_edge X Y a -> partial_edge X Y b -> partial_edge X Y c -> 0 <= r -> 0 <= s ->
  0 <= t -> r + s + t = 1 -> partial_edge X Y (r * fst a + s * fst b + t * fst c, r * snd a + s * snd b + t * snd c).
Proof.
  intros A B C R S T E. destruct (Req_dec (r + s) 0) as [Z | Z].
  - replace (_, _) with c; [exact C |]. assert (r = 0) by lra. assert (s = 0) by lra. assert (t = 1) by lra. subst.
    destruct c. simpl. f_equal; ring.
  - set (k := s / (r + s)). assert (P : 0 < r + s) by lra.
    assert (K : 0 <= k <= 1).
    { unfold k. split; [apply Rmult_le_pos; [lra | left; now apply Rinv_0_lt_compat] |].
      apply (Rmult_le_reg_r (r + s)); [exact P |]. unfold Rdiv. rewrite Rmult_assoc, Rinv_l by lra. lra. }
    assert (Ks : (r + s) * k = s) by (unfold k; field; lra).
    pose proof (edge_convex X Y _ _ t (edge_convex X Y a b k A B K) C ltac:(lra)) as M.
    assert (Q : mix t (mix k a b) c = (r * fst a + s * fst b + t * fst c, r * snd a + s * snd b + t * snd c)).
    { unfold mix. simpl. replace (1 - t) with (r + s) by lra. f_equal.
      - transitivity ((r + s - (r + s) * k) * fst a + (r + s) * k * fst b + t * fst c); [ring | rewrite Ks; ring].
      - transitivity ((r + s - (r + s) * k) * snd a + (r + s) * k * snd b + t * snd c); [ring | rewrite Ks; ring]. }
    now rewrite <- Q.
Qed.

(* ---- corners ---- *)

(* Of the rectangle: to the right or left, above or below. *)
Definition like (right upper : bool) (B : rect) : point :=
  (if right then xhi B else xlo B, if upper then yhi B else ylo B).

Definition corners (B : rect) : list point := [like true true B; like true false B; like false true B;
  like false false B].

Lemma like_inside r u B : inside (like r u B) B.
Proof. pose proof (x_ordered B). pose proof (y_ordered B). unfold inside, like. destruct r, u; simpl; lra. Qed.

Lemma corner_edge X Y z : In z (corners X ++ corners Y) -> partial_edge X Y z.
Proof.
  assert (L : forall w, inside w X -> partial_edge X Y w).
  { intros w W. exists w, (like true true Y). split; [exact W |]. split; [apply like_inside |]. exists 0.
    split; [lra | now rewrite mix_0]. }
  assert (R : forall w, inside w Y -> partial_edge X Y w).
  { intros w W. exists (like true true X), w. split; [apply like_inside |]. split; [exact W |]. exists 1.
    split; [lra | now rewrite mix_1]. }
  simpl. intros H. repeat destruct H as [<- | H]; try contradiction;
    first [apply L; apply like_inside | apply R; apply like_inside].
Qed.

(* The directions of a quadrant. *)
Definition in_quadrant (r u : bool) (e : point) : Prop :=
  (if r then 0 <= fst e else fst e <= 0) /\ (if u then 0 <= snd e else snd e <= 0).

Lemma like_highest r u e B z : in_quadrant r u e -> inside z B -> dot e z <= dot e (like r u B).
Proof.
  intros [X Y] [Ix Iy]. unfold dot, like. simpl.
  assert (fst e * fst z <= fst e * (if r then xhi B else xlo B)) by (destruct r; nra).
  assert (snd e * snd z <= snd e * (if u then yhi B else ylo B)) by (destruct u; nra). lra.
Qed.

Lemma like_lowest r u e B z : in_quadrant r u e -> inside z B -> dot e (like (negb r) (negb u) B) <= dot e z.
Proof.
  intros [X Y] [Ix Iy]. unfold dot, like. simpl.
  assert (fst e * (if negb r then xhi B else xlo B) <= fst e * fst z) by (destruct r; simpl; nra).
  assert (snd e * (if negb u then yhi B else ylo B) <= snd e * snd z) by (destruct u; simpl; nra). lra.
Qed.

(* ---- directions that separate ---- *)

Definition precedes (e : point) (a b c d : rect) : Prop :=
  forall x y, inside x a \/ inside x b -> inside y c \/ inside y d -> dot e x < dot e y.

(* As the code has it: the support of a and b against that of c and d. *)
Theorem precedes_supports e a b c d : precedes e a b c d <->
  (dot e (highest e a) < dot e (lowest e c) /\ dot e (highest e a) < dot e (lowest e d)) /\
  (dot e (highest e b) < dot e (lowest e c) /\ dot e (highest e b) < dot e (lowest e d)).
Proof.
  split.
  - intros P. repeat split; apply P; solve [left; apply highest_spec | right; apply highest_spec |
      left; apply lowest_spec | right; apply lowest_spec].
  - intros [[A B] [C D]] x y [X | X] [Y | Y]; pose proof (proj2 (highest_spec e _) x X);
      pose proof (proj2 (lowest_spec e _) y Y); lra.
Qed.

Theorem direction_separates e a b c d z : precedes e a b c d -> partial_edge a b z -> ~ partial_edge c d z.
Proof.
  intros P [x [y [X [Y [t [T ->]]]]]] [x' [y' [X' [Y' [s [S E]]]]]].
  assert (Q : dot e (mix t x y) = dot e (mix s x' y')) by now rewrite E. rewrite !dot_mix in Q.
  pose proof (P x x' (or_introl X) (or_introl X')). pose proof (P x y' (or_introl X) (or_intror Y')).
  pose proof (P y x' (or_intror Y) (or_introl X')). pose proof (P y y' (or_intror Y) (or_intror Y')).
  set (m := Rmax (dot e x) (dot e y)).
  assert (dot e x <= m) by apply Rmax_l. assert (dot e y <= m) by apply Rmax_r.
  assert (m < dot e x') by (now apply Rmax_lub_lt). assert (m < dot e y') by (now apply Rmax_lub_lt).
  assert (0 <= (1 - t) * (m - dot e x)) by (apply Rmult_le_pos; lra).
  assert (0 <= t * (m - dot e y)) by (apply Rmult_le_pos; lra).
  assert (0 <= (1 - s) * (dot e x' - m)) by (apply Rmult_le_pos; lra).
  destruct (Req_dec s 0) as [-> | S0]; [lra |].
  assert (0 < s * (dot e y' - m)) by (apply Rmult_lt_0_compat; lra). lra.
Qed.

(* A direction between e and f, and a vector v: both ends can be brought in, to a direction across v, so that v has the
   same side of both. *)
Lemma brought_in n e f v s t : 0 <= s -> 0 <= t -> n = sum2 s e t f ->
  exists e' f' s' t', 0 <= s' /\ 0 <= t' /\ n = sum2 s' e' t' f' /\
    (0 <= dot e' v /\ 0 <= dot f' v \/ dot e' v <= 0 /\ dot f' v <= 0) /\
    (forall g, g = e' \/ g = f' -> (exists x y, 0 <= x /\ 0 <= y /\ g = sum2 x e y f) /\
      (g = e \/ g = f \/ (dot g v = 0 /\ v <> (0, 0)))).
Proof.
  intros S T E.
  assert (Keep : 0 <= dot e v /\ 0 <= dot f v \/ dot e v <= 0 /\ dot f v <= 0 -> exists e' f' s' t', 0 <= s' /\
    0 <= t' /\
    n = sum2 s' e' t' f' /\ (0 <= dot e' v /\ 0 <= dot f' v \/ dot e' v <= 0 /\ dot f' v <= 0) /\
    (forall g, g = e' \/ g = f' -> (exists x y, 0 <= x /\ 0 <= y /\ g = sum2 x e y f) /\
      (g = e \/ g = f \/ (dot g v = 0 /\ v <> (0, 0))))).
  { intros Side. exists e, f, s, t. split; [exact S |]. split; [exact T |]. split; [exact E |]. split; [exact Side |].
    intros g [-> | ->]; (split; [| tauto]); [exists 1, 0 | exists 0, 1]; repeat split; try lra;
      [destruct e | destruct f]; unfold sum2; simpl; f_equal; ring. }
  destruct (classic (0 <= dot e v /\ 0 <= dot f v \/ dot e v <= 0 /\
    dot f v <= 0)) as [Side | Side]; [now apply Keep |].
  clear Keep. set (x := Rabs (dot f v)). set (y := Rabs (dot e v)). set (m := sum2 x e y f).
  assert (De : dot e v <> 0) by (intros Z; apply Side; destruct (Rle_dec 0 (dot f v)); lra).
  assert (Df : dot f v <> 0) by (intros Z; apply Side; destruct (Rle_dec 0 (dot e v)); lra).
  assert (X : 0 < x) by now apply Rabs_pos_lt. assert (Y : 0 < y) by now apply Rabs_pos_lt.
  assert (V : v <> (0, 0)) by (intros ->; apply De; unfold dot; simpl; ring).
  assert (M : dot m v = x * dot e v + y * dot f v) by (unfold m, dot, sum2; simpl; ring).
  assert (M0 : dot m v = 0).
  { rewrite M. unfold x, y. destruct (Rle_dec 0 (dot e v)).
    - rewrite (Rabs_left (dot f v)) by lra. rewrite (Rabs_pos_eq (dot e v)) by lra. ring.
    - rewrite (Rabs_pos_eq (dot f v)) by lra. rewrite (Rabs_left (dot e v)) by lra. ring. }
  assert (Mem : forall g, g = e \/ g = f \/ g = m -> (exists x y, 0 <= x /\ 0 <= y /\ g = sum2 x e y f) /\
      (g = e \/ g = f \/ (dot g v = 0 /\ v <> (0, 0)))).
  { intros g [-> | [-> | ->]]; (split; [| tauto]); [exists 1, 0 | exists 0, 1 | exists x, y]; repeat split; try lra;
      [destruct e | destruct f]; unfold sum2; simpl; f_equal; ring. }
  assert (Sides : forall w, 0 <= dot w v /\ 0 <= dot m v \/ dot w v <= 0 /\ dot m v <= 0)
    by (intros w; rewrite M0; destruct (Rle_dec 0 (dot w v)); [left | right]; lra).
  destruct (Rle_dec (t * x) (s * y)) as [L | L].
  - (* n between e and m: t f = (t / y) (m - x e) *)
    exists e, m, (s - t / y * x), (t / y).
      assert (0 <= t / y) by (apply Rmult_le_pos; [lra | left; now apply Rinv_0_lt_compat]).
    split. { apply (Rmult_le_reg_r y); [exact Y |].
      replace ((s - t / y * x) * y) with (s * y - t * x) by (field; lra). lra. }
    split; [assumption |]. split; [rewrite E; unfold m, sum2; simpl; f_equal; field; lra |]. split; [apply Sides |].
    intros g G. apply Mem. tauto.
  - exists f, m, (t - s / x * y), (s / x).
    assert (0 <= s / x) by (apply Rmult_le_pos; [lra | left; now apply Rinv_0_lt_compat]).
    split. { apply (Rmult_le_reg_r x); [exact X |].
      replace ((t - s / x * y) * x) with (t * x - s * y) by (field; lra). lra. }
    split; [assumption |]. split; [rewrite E; unfold m, sum2; simpl; f_equal; field; lra |]. split; [apply Sides |].
    intros g G. apply Mem. tauto.
Qed.

(* The ten: the axes; across the joins of like corners of a and b, and of c and d. *)
Definition across_join (a b : rect) (r u : bool) : point :=
  (snd (like r u a) - snd (like r u b), fst (like r u b) - fst (like r u a)).

Definition ten (a b c d : rect) (e : point) : Prop := e = (1, 0) \/ e = (0, 1) \/
  exists r u, e = across_join a b r u \/ e = across_join c d r u.

Lemma precedes_scaled k e a b c d : precedes (k * fst e, k * snd e) a b c d -> precedes e a b c d \/ precedes e c d a b.
Proof.
  intros P. assert (D : forall z, dot (k * fst e, k * snd e) z = k * dot e z) by (intros; unfold dot; simpl; ring).
  destruct (Rle_dec k 0) as [K | K]; [right | left]; intros x y X Y.
  - pose proof (P y x Y X) as Q. rewrite !D in Q. nra.
  - pose proof (P x y X Y) as Q. rewrite !D in Q. nra.
Qed.

(* Each vector across v is a multiple of one vector. *)
Lemma across_multiple v g : v <> (0, 0) -> dot g v = 0 -> exists k, g = (k * - snd v, k * fst v).
Proof.
  intros V G. assert (P : 0 < dot v v).
  { destruct v as [x y]. unfold dot. simpl. destruct (Req_dec x 0) as [-> | X]; [| nra].
    destruct (Req_dec y 0) as [-> | Y]; [now elim V | nra]. }
  exists ((snd g * fst v - fst g * snd v) / dot v v). rewrite (surjective_pairing g) at 1.
  f_equal; apply (Rmult_eq_reg_r (dot v v)); try lra.
  - transitivity (- (snd g * fst v - fst g * snd v) * snd v + dot g v * fst v); [unfold dot; ring | rewrite G; field;
    lra].
  - transitivity ((snd g * fst v - fst g * snd v) * fst v + dot g v * snd v); [unfold dot; ring | rewrite G; field;
    lra].
Qed.

Theorem ten_directions a b c d : (forall z, partial_edge a b z -> ~ partial_edge c d z) <->
  exists e, ten a b c d e /\ (precedes e a b c d \/ precedes e c d a b).
Proof.
  split.
  2: { intros [e [_ [P | P]]] z Z W;
    [now apply (direction_separates e a b c d z) | now apply (direction_separates e c d a b z)]. }
  intros Apart. set (diff := flat_map (fun x => map (fun y => (fst y - fst x, snd y - snd x)) (corners c ++ corners d))
    (corners a ++ corners b)).
  assert (InD : forall w, In w diff -> exists x y, In x (corners a ++ corners b) /\ In y (corners c ++ corners d) /\
    w = (fst y - fst x, snd y - snd x)).
  { intros w W. apply in_flat_map in W as [x [X W]]. apply in_map_iff in W as [y [<- Y]]. now exists x, y. }
  destruct (ahead_or_cancel diff) as [[n Ahead] | [v1 [v2 [v3 [r [s [t [V1 [V2 [V3 [R [S [T [P [E1 E2]]]]]]]]]]]]]]].
  2: { exfalso. destruct (InD _ V1) as [x1 [y1 [X1 [Y1 ->]]]]. destruct (InD _ V2) as [x2 [y2 [X2 [Y2 ->]]]].
    destruct (InD _ V3) as [x3 [y3 [X3 [Y3 ->]]]]. simpl in E1, E2. set (w := r + s + t) in *.
    assert (I : 0 < / w) by now apply Rinv_0_lt_compat.
    assert (Pr : 0 <= r / w) by (apply Rmult_le_pos; lra). assert (Ps : 0 <= s / w) by (apply Rmult_le_pos; lra).
    assert (Pt : 0 <= t / w) by (apply Rmult_le_pos; lra).
    assert (Sum : r / w + s / w + t / w = 1) by (unfold w in *; field; lra).
    apply (Apart _ (edge_three a b x1 x2 x3 _ _ _ (corner_edge a b _ X1) (corner_edge a b _ X2) (corner_edge a b _
      X3) Pr Ps Pt Sum)).
    replace (_, _) with (r / w * fst y1 + s / w * fst y2 + t / w * fst y3,
      r / w * snd y1 + s / w * snd y2 + t / w * snd y3).
    - apply edge_three; auto; apply corner_edge; assumption.
    - f_equal; apply Rminus_diag_uniq.
      + transitivity (/ w * (r * (fst y1 - fst x1) + s * (fst y2 - fst x2) + t * (fst y3 - fst x3))); [unfold Rdiv;
        ring |].
        rewrite E1. ring.
      + transitivity (/ w * (r * (snd y1 - snd x1) + s * (snd y2 - snd x2) + t * (snd y3 - snd x3))); [unfold Rdiv;
        ring |].
        rewrite E2. ring. }
  assert (Order : forall x y, In x (corners a ++ corners b) -> In y (corners c ++ corners d) -> dot n x < dot n y).
  { intros x y X Y. pose proof (Ahead (fst y - fst x, snd y - snd x)) as Q.
    assert (0 < dot n (fst y - fst x, snd y - snd x)); [| unfold dot in *; simpl in *; lra].
    apply Q, in_flat_map. exists x. split; [exact X |]. apply in_map_iff. now exists y. }
  (* the quadrant of n *)
  assert (Quad : exists ri up e f s t, 0 <= s /\ 0 <= t /\ n = sum2 s e t f /\ in_quadrant ri up e /\
    in_quadrant ri up f /\
    (exists k, e = (k * 1, k * 0)) /\ exists k, f = (k * 0, k * 1)).
  { exists (if Rle_dec 0 (fst n) then true else false), (if Rle_dec 0 (snd n) then true else false).
    exists (if Rle_dec 0 (fst n) then (1, 0) else (-1, 0)), (if Rle_dec 0 (snd n) then (0, 1) else (0, -1)).
    exists (Rabs (fst n)), (Rabs (snd n)). split; [apply Rabs_pos |]. split; [apply Rabs_pos |]. split.
    - destruct n as [n1 n2]. unfold sum2. simpl.
      destruct (Rle_dec 0 n1); destruct (Rle_dec 0 n2); simpl;
        try rewrite (Rabs_pos_eq n1) by lra; try rewrite (Rabs_pos_eq n2) by lra; try rewrite (Rabs_left n1) by lra;
        try rewrite (Rabs_left n2) by lra; f_equal; ring.
    - unfold in_quadrant. destruct (Rle_dec 0 (fst n)); destruct (Rle_dec 0 (snd n)); simpl; repeat split; try lra;
        solve [exists 1; f_equal; ring | exists (-1); f_equal; ring]. }
  destruct Quad as [ri [up [e [f [s [t [S [T [En [Qe [Qf [[ke Ke] [kf Kf]]]]]]]]]]]]].
  set (A := like ri up a). set (A2 := like ri up b). set (C := like (negb ri) (negb up) c).
    set (C2 := like (negb ri) (negb up) d).
  set (v := (fst A2 - fst A, snd A2 - snd A)). set (w := (fst C2 - fst C, snd C2 - snd C)).
  destruct (brought_in n e f v s t S T En) as [e1 [f1 [s1 [t1 [S1 [T1 [En1 [Side1 Mem1]]]]]]]].
  destruct (brought_in n e1 f1 w s1 t1 S1 T1 En1) as [e2 [f2 [s2 [t2 [S2 [T2 [En2 [Side2 Mem2]]]]]]]].
  assert (QuadMix : forall x y g h, 0 <= x -> 0 <= y -> in_quadrant ri up g -> in_quadrant ri up h ->
    in_quadrant ri up (sum2 x g y h)).
  { intros x y g h X Y [G1 G2] [H1 H2]. unfold in_quadrant, sum2. simpl. split; [destruct ri | destruct up]; nra. }
  assert (Q1 : forall g, g = e1 \/ g = f1 -> in_quadrant ri up g).
  { intros g G. destruct (Mem1 g G) as [[x [y [X [Y ->]]]] _]. now apply QuadMix. }
  assert (Q2 : forall g, g = e2 \/ g = f2 -> in_quadrant ri up g).
  { intros g G. destruct (Mem2 g G) as [[x [y [X [Y ->]]]] _]. apply QuadMix; auto. }
  assert (Dmix : forall x g y h z, dot (sum2 x g y h) z = x * dot g z + y * dot h z) by (intros; unfold dot, sum2;
    simpl; ring).
  assert (Side : 0 <= dot e2 v /\ 0 <= dot f2 v \/ dot e2 v <= 0 /\ dot f2 v <= 0).
  { destruct (Mem2 e2 (or_introl eq_refl)) as [[x [y [X [Y E]]]] _].
    destruct (Mem2 f2 (or_intror eq_refl)) as [[x' [y' [X' [Y' E']]]] _].
    rewrite E, E', !Dmix. destruct Side1 as [[G H] | [G H]]; [left | right]; split; nra. }
  assert (Dv : forall g, dot g v = dot g A2 - dot g A) by (intros; unfold v, dot; simpl; ring).
  assert (Dw : forall g, dot g w = dot g C2 - dot g C) by (intros; unfold w, dot; simpl; ring).
  assert (Top : exists p, In p (corners a ++ corners b) /\
    forall g x, g = e2 \/ g = f2 -> inside x a \/ inside x b -> dot g x <= dot g p).
  { destruct Side as [[G H] | [G H]]; [exists A2 | exists A]; rewrite !Dv in G, H; (split; [unfold A, A2;
    destruct ri, up; simpl; tauto |]);
      intros g x Gs [X | X]; pose proof (like_highest ri up g _ x (Q2 g Gs) X) as Z; fold A A2 in Z;
        destruct Gs as [-> | ->]; lra. }
  assert (Bottom : exists q, In q (corners c ++ corners d) /\
    forall g y, g = e2 \/ g = f2 -> inside y c \/ inside y d -> dot g q <= dot g y).
  { destruct Side2 as [[G H] | [G H]]; [exists C | exists C2]; rewrite !Dw in G, H; (split; [unfold C, C2;
    destruct ri, up; simpl; tauto |]);
      intros g y Gs [Y | Y]; pose proof (like_lowest ri up g _ y (Q2 g Gs) Y) as Z; fold C C2 in Z;
        destruct Gs as [-> | ->]; lra. }
  destruct Top as [p [Ip Hp]]. destruct Bottom as [q [Iq Hq]]. pose proof (Order p q Ip Iq) as Lt.
    rewrite En2, !Dmix in Lt.
  assert (One : exists g, (g = e2 \/ g = f2) /\ dot g p < dot g q).
  { destruct (Rlt_dec (dot e2 p) (dot e2 q)) as [L | L]; [exists e2; now split; [left |] |]. exists f2.
    split; [now right |].
    apply Rnot_le_lt. intros M. assert (s2 * dot e2 q <= s2 * dot e2 p) by (apply Rmult_le_compat_l; lra).
    assert (t2 * dot f2 q <= t2 * dot f2 p) by (apply Rmult_le_compat_l; lra). lra. }
  destruct One as [g [Gs Lg]].
  assert (Sep : precedes g a b c d).
  { intros x y X Y. pose proof (Hp g x Gs X). pose proof (Hq g y Gs Y). lra. }
  assert (Multiple : exists k h, ten a b c d h /\ g = (k * fst h, k * snd h)).
  { assert (AxisE : exists k h, ten a b c d h /\
    e = (k * fst h, k * snd h)) by (exists ke, (1, 0); split; [now left | exact Ke]).
    assert (AxisF : exists k h, ten a b c d h /\ f = (k * fst h, k * snd h))
      by (exists kf, (0, 1); split; [right; now left | exact Kf]).
    assert (First : forall g, g = e1 \/ g = f1 -> exists k h, ten a b c d h /\ g = (k * fst h, k * snd h)).
    { intros g' G. destruct (Mem1 g' G) as [_ [-> | [-> | [Z V]]]]; [exact AxisE | exact AxisF |].
      destruct (across_multiple v g' V Z) as [k K]. exists k, (across_join a b ri up). split.
      - right. right. exists ri, up. now left.
      - rewrite K. unfold across_join, v. simpl. fold A A2. f_equal; ring. }
    destruct (Mem2 g Gs) as [_ [-> | [-> | [Z V]]]]; [apply First; now left | apply First; now right |].
    destruct (across_multiple w g V Z) as [k K]. exists k, (across_join c d (negb ri) (negb up)). split.
    - right. right. exists (negb ri), (negb up). now right.
    - rewrite K. unfold across_join, w. simpl. fold C C2. f_equal; ring. }
  destruct Multiple as [k [h [Th ->]]]. exists h. split; [exact Th | now apply (precedes_scaled k)].
Qed.
