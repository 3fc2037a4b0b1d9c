(* SPDX-License-Identifier: LGPL-3.0-or-later *)
(* Points that the checker takes are where the certificate says, whatever the callbacks are;
  facts that it takes hold of them. *)
From Coq Require Import Reals Lra Lia ZArith NArith List Bool.
From Dyadel Require Import Plane Checker CheckerSound CheckerEnclosure CheckerEnclosureSound CheckerAlgebra
  CheckerAlgebraSound.
From Dyadel Require Import CheckerBlock CheckerBlockSound CheckerVanish CheckerVanishSound CheckerFacts.
Import ListNotations.
Open Scope R_scope.
Local Opaque mul add sub q_add q_sub q_mul.

Lemma fraction_value n : (0 < den n)%Z ->
  value n = IZR (fst (fraction_of n)) / IZR (snd (fraction_of n)) /\ (0 < snd (fraction_of n))%Z.
Proof.
  intros D. unfold fraction_of, value. cbn [fst snd]. pose proof (IZR_lt _ _ D) as D'.
  assert (P : forall m, (0 <= m)%Z -> 0 < powerRZ 2 m) by (intros; apply powerRZ_lt; lra).
  split; [| rewrite Z.shiftl_mul_pow2 by lia; assert (0 < 2 ^ Z.max 0 (- expo n))%Z by (apply Z.pow_pos_nonneg;
    lia); nia].
  rewrite !shift_value by lia. destruct (Z.le_ge_cases 0 (expo n)) as [E | E].
  - rewrite (Z.max_r 0 (expo n)), (Z.max_l 0 (- expo n)) by lia. simpl (powerRZ 2 0). field. lra.
  - rewrite (Z.max_l 0 (expo n)), (Z.max_r 0 (- expo n)) by lia. simpl (powerRZ 2 0).
    pose proof (P (- expo n)%Z ltac:(lia)) as B.
    assert (Q : powerRZ 2 (expo n) * powerRZ 2 (- expo n) = 1) by (rewrite <- powerRZ_add by lra;
      rewrite Z.add_opp_diag_r; reflexivity).
    replace (powerRZ 2 (expo n)) with (/ powerRZ 2 (- expo n)) by (apply Rmult_eq_reg_r with (powerRZ 2 (- expo n));
      [rewrite Rinv_l; lra | lra]).
    field. split; lra.
Qed.

Section Sound.

Variable v : Z -> R.
Variable l : nat -> R.
Variable most u : Z.
Variable U : (0 < u)%Z.
Variable st : state.
Variable St : state_ok v l u st.
Variable hint : poly -> cofactor.

Let R0 := relations_there v l u st St.
Notation ok := (known_ok l u).

Lemma null_there_ok q r : is_quotient l q r -> is_null_there most u st hint q = true -> r = 0.
Proof.
  intros Q E. unfold is_null_there in E. apply orb_prop in E as [E | E]; [exact (null_is_zero l _ _ Q E) |].
  destruct q as [[p d] |]; [| discriminate].
  exact (vanishing_quotient l most u U _ R0 _ (leaves_there v l u st St) p d r (hint p) Q E).
Qed.

Lemma is_in_ok x r lo hi : ok x r -> is_in most u st hint x lo hi = true -> value lo <= r <= value hi.
Proof.
  intros [X Q] E. unfold is_in in E. destruct (fraction_of lo) as [a b] eqn:Fa.
    destruct (fraction_of hi) as [c d] eqn:Fc.
  apply andb_prop in E as [E C]. apply andb_prop in E as [A B]. apply Z.ltb_lt in A, B.
  destruct (fraction_value lo A) as [La Pb]. destruct (fraction_value hi B) as [Lc Pd]. rewrite Fa in *.
    rewrite Fc in *. cbn [fst snd] in *.
  apply IZR_lt in Pb, Pd. pose proof (IZR_lt _ _ U) as U'. rewrite La, Lc.
  assert (Eb : IZR a / IZR b * IZR b = IZR a) by (field; lra).
    assert (Ed : IZR c / IZR d * IZR d = IZR c) by (field; lra).
  apply orb_prop in C as [C | C].
  - destruct (within x) as [[p q] |]; [| discriminate]. apply andb_prop in C as [L H]. rewrite Z.leb_le in L, H.
    apply IZR_le in L, H. rewrite !mult_IZR in L, H. simpl in X. split.
    + apply Rmult_le_reg_r with (IZR b * IZR u); [now apply Rmult_lt_0_compat |]. nra.
    + apply Rmult_le_reg_r with (IZR d * IZR u); [now apply Rmult_lt_0_compat |]. nra.
  - apply andb_prop in C as [G C]. apply Z.eqb_eq in G. apply (f_equal IZR) in G. rewrite !mult_IZR in G.
    pose proof (null_there_ok _ _ (q_sub_is l most _ R0 _ _ _ _ Q (q_fraction_is l most a b)) C) as W.
    assert (r = IZR a / IZR b) by lra. subst r. clear W.
    assert (IZR a / IZR b = IZR c / IZR d); [| lra]. apply Rmult_eq_reg_r with (IZR b * IZR d); [| nra].
    transitivity (IZR a * IZR d); [field; lra |]. rewrite G. field. lra.
Qed.

Lemma with_number_ok f a : with_number st f a = true -> exists x, ok x (v a) /\ f x = true.
Proof.
  unfold with_number. destruct (Map.find a (numbers st)) as [x |] eqn:F; [| discriminate]. intros E. exists x.
    split; [| exact E].
  exact (proj1 St a x F).
Qed.

(* The point. *)
Definition point_of (p : place) : point := (v (at_first p), v (at_second p)).

Theorem place_in_ok p s : place_in most u st hint p s = true ->
  value (left s) <= fst (point_of p) <= value (right s) /\ value (low s) <= snd (point_of p) <= value (high s).
Proof.
  intros E. apply andb_prop in E as [X Y]. apply with_number_ok in X as (x & Kx & X).
    apply with_number_ok in Y as (y & Ky & Y).
  split; [exact (is_in_ok x _ _ _ Kx X) | exact (is_in_ok y _ _ _ Ky Y)].
Qed.

Lemma number_at_ok a : ok (number_at st a) (v a).
Proof. unfold number_at. destruct (Map.find a (numbers st)) as [x |] eqn:F; [exact (proj1 St a x F) | split;
  exact I]. Qed.

Lemma less_ok x y r s : ok x r -> ok y s -> ok (less most st x y) (r - s).
Proof. intros [] []. split; [now apply sub_holds | now apply q_sub_is]. Qed.
Lemma product_with_ok x y r s : ok x r -> ok y s -> ok (product_with most u st x y) (r * s).
Proof. intros [] []. split; [now apply mul_holds | now apply q_mul_is]. Qed.
Lemma sum_with_ok x y r s : ok x r -> ok y s -> ok (sum_with most st x y) (r + s).
Proof. intros [] []. split; [now apply add_holds | now apply q_add_is]. Qed.

Lemma zero_ok x r : ok x r -> is_zero most u st hint x = true -> r = 0.
Proof. intros [_ Q]. exact (null_there_ok _ _ Q). Qed.
Lemma no_zero_ok x r : ok x r -> is_no_zero x = true -> r <> 0.
Proof. intros [H _] E. apply negb_true_iff, Z.eqb_neq in E. exact (sign_not_zero u U _ _ H E). Qed.

Definition dx (a b : place) : R := fst (point_of b) - fst (point_of a).
Definition dy (a b : place) : R := snd (point_of b) - snd (point_of a).

Lemma step_x_ok a b : ok (step_x most st a b) (dx a b).
Proof. apply less_ok; apply number_at_ok. Qed.
Lemma step_y_ok a b : ok (step_y most st a b) (dy a b).
Proof. apply less_ok; apply number_at_ok. Qed.

Lemma cross_ok ax ay bx by_ p q r s : ok ax p -> ok ay q -> ok bx r -> ok by_ s ->
  ok (cross most u st ax ay bx by_) (p * s - q * r).
Proof. intros. unfold cross. apply less_ok; now apply product_with_ok. Qed.
Lemma square_ok x r : ok x r -> ok (square most u st x) (r * r).
Proof.
  intros [X Q]. split; [| now apply q_mul_is]. cbn [square within]. fold (Rsqr r). rewrite Rsqr_abs. unfold Rsqr.
  apply mul_holds; [exact U | |]; now apply absolute_holds.
Qed.
Lemma norm_ok x y r s : ok x r -> ok y s -> ok (norm most u st x y) (r * r + s * s).
Proof. intros. unfold norm. apply sum_with_ok; now apply square_ok. Qed.

(* ---- what a fact says ---- *)

Definition fact_true (f : fact) : Prop :=
  match f with
  | Same a b => point_of a = point_of b
  | OnLine a b ps => point_of a <> point_of b /\ forall d, In d ps -> dx a b * dy a d - dy a b * dx a d = 0
  | OnCircle a b c ps => dx a b * dy a c - dy a b * dx a c <> 0 /\
    exists o r, 0 < r /\ forall d, d = a \/ d = b \/ d = c \/ In d ps -> dist2 o (point_of d) = r
  end.

Lemma circle_through (vx vy wx wy : R) : vx * wy - vy * wx <> 0 -> exists cx cy, forall x y,
  x * ((wx * wx + wy * wy) * vy - (vx * vx + vy * vy) * wy) + y * ((vx * vx + vy * vy) * wx - (wx * wx + wy * wy) *
    vx)
    + (x * x + y * y) * (vx * wy - vy * wx) = (vx * wy - vy * wx) * ((x - cx) * (x - cx) + (y - cy) * (y - cy) - (cx
      * cx + cy * cy)).
Proof.
  intros D. exists (((vx * vx + vy * vy) * wy - (wx * wx + wy * wy) * vy) / (2 * (vx * wy - vy * wx))),
    (((wx * wx + wy * wy) * vx - (vx * vx + vy * vy) * wx) / (2 * (vx * wy - vy * wx))). intros x y. field. exact D.
Qed.

(* 0 on the circle through a, b and c, for a place z. *)
Definition off_at (a b c : place) (z : point) : R :=
  let x := fst z - fst (point_of a) in let y := snd z - snd (point_of a) in
  x * ((dx a c * dx a c + dy a c * dy a c) * dy a b - (dx a b * dx a b + dy a b * dy a b) * dy a c)
  + y * ((dx a b * dx a b + dy a b * dy a b) * dx a c - (dx a c * dx a c + dy a c * dy a c) * dx a b)
  + (x * x + y * y) * (dx a b * dy a c - dy a b * dx a c).

Lemma off_ok a b c x y z : ok x (fst z - fst (point_of a)) -> ok y (snd z - snd (point_of a)) ->
  let g := base_of most u st a b c in
  ok (sum_with most st (sum_with most st (product_with most u st x (along_x g)) (product_with most u st y (along_y
    g)))
    (product_with most u st (norm most u st x y) (area g))) (off_at a b c z).
Proof.
  intros X Y. cbv zeta. unfold base_of. cbn [area along_x along_y].
  pose proof (step_x_ok a b) as Vx. pose proof (step_y_ok a b) as Vy.
  pose proof (step_x_ok a c) as Wx. pose proof (step_y_ok a c) as Wy.
  unfold off_at. cbv zeta. apply sum_with_ok; [apply sum_with_ok; apply product_with_ok | apply product_with_ok];
    trivial.
  - apply less_ok; apply product_with_ok; trivial; now apply norm_ok.
  - apply less_ok; apply product_with_ok; trivial; now apply norm_ok.
  - now apply norm_ok.
  - now apply cross_ok.
Qed.

Lemma circle_holds_ok a b c ps : fact_holds most u st hint (OnCircle a b c ps) = true ->
  dx a b * dy a c - dy a b * dx a c <> 0 /\ exists o r, 0 < r /\
    (forall z, off_at a b c z = (dx a b * dy a c - dy a b * dx a c) * (dist2 o z - r)) /\
    forall d, d = a \/ d = b \/ d = c \/ In d ps -> dist2 o (point_of d) = r.
Proof.
  intros E. cbn [fact_holds] in E. cbv zeta in E. apply andb_prop in E as [N E].
  assert (D : dx a b * dy a c - dy a b * dx a c <> 0).
  { refine (no_zero_ok _ _ (cross_ok _ _ _ _ _ _ _ _ (step_x_ok a b) (step_y_ok a b) (step_x_ok a c) (step_y_ok a
    c)) N). }
  split; [exact D |]. destruct (circle_through _ _ _ _ D) as (cx & cy & G).
  set (o := (fst (point_of a) + cx, snd (point_of a) + cy)).
  assert (Off : forall z, off_at a b c z = (dx a b * dy a c - dy a b * dx a c) * (dist2 o z - (cx * cx + cy * cy))).
  { intros z. unfold off_at. cbv zeta. rewrite G. unfold dist2, o. simpl. ring. }
  exists o, (cx * cx + cy * cy). split; [| split; [exact Off |]].
  - destruct (Req_dec cx 0) as [X | X]; [| nra]. destruct (Req_dec cy 0) as [Y | Y]; [| nra]. exfalso. subst cx cy.
    assert (B : dx a b * dx a b + dy a b * dy a b = 0).
    { pose proof (G (dx a b) (dy a b)) as H. apply Rmult_eq_reg_l with (dx a b * dy a c - dy a b * dx a c);
      [| exact D]. lra. }
    assert (dx a b = 0) by nra. assert (dy a b = 0) by nra. apply D. rewrite H, H0. ring.
  - assert (On : forall d, off_at a b c (point_of d) = 0 -> dist2 o (point_of d) = cx * cx + cy * cy).
    { intros d Z. rewrite Off in Z. apply Rmult_integral in Z as [Z | Z]; [contradiction | lra]. }
    intros d [-> | [-> | [-> | I]]]; apply On.
    + unfold off_at. cbv zeta. ring.
    + unfold off_at. cbv zeta. fold (dx a b) (dy a b). ring.
    + unfold off_at. cbv zeta. fold (dx a c) (dy a c). ring.
    + rewrite forallb_forall in E. specialize (E d I).
      exact (zero_ok _ _ (off_ok a b c _ _ (point_of d) (step_x_ok a d) (step_y_ok a d)) E).
Qed.

Theorem fact_holds_ok f : fact_holds most u st hint f = true -> fact_true f.
Proof.
  intros E. destruct f as [a b | a b ps | a b c ps].
  - cbn [fact_holds fact_true] in *. apply andb_prop in E as [X Y]. apply (zero_ok _ _ (step_x_ok a b)) in X.
    apply (zero_ok _ _ (step_y_ok a b)) in Y. unfold dx, dy, point_of in *. simpl in X, Y. f_equal; lra.
  - cbn [fact_holds fact_true] in *. apply andb_prop in E as [N E]. split.
    + intros Q. apply orb_prop in N as [N | N].
      * apply (no_zero_ok _ _ (step_x_ok a b)) in N. apply N. unfold dx. rewrite Q. ring.
      * apply (no_zero_ok _ _ (step_y_ok a b)) in N. apply N. unfold dy. rewrite Q. ring.
    + intros d D. rewrite forallb_forall in E.
      apply (zero_ok _ _ (cross_ok _ _ _ _ _ _ _ _ (step_x_ok a b) (step_y_ok a b) (step_x_ok a d) (step_y_ok a d))
        (E d D)).
  - destruct (circle_holds_ok a b c ps E) as [D (o & r & P & _ & M)]. split; [exact D |]. now exists o, r.
Qed.

End Sound.

(* ---- a block as a whole ---- *)

Lemma nothing_ok v l u : state_ok v l u nothing.
Proof. split; [intros a x F; destruct (Map.empty_1 (Map.find_2 F)) | intros [| j] f F; discriminate]. Qed.

(* Whatever numbers v are described by the lines (and leaves l are what the checker says they are): each is defined;
  points
   that are taken lie in the rectangles, and facts that are taken hold. *)
Theorem accepted_block most root_hint zero_hint pi_hint cofactor_hint u ls st v l : (0 < u)%Z ->
  run most root_hint zero_hint u (pi_at most pi_hint u) nothing 0 ls = inl st -> agrees v l (leaves st) ->
  (forall j o, line_at 0 ls j o -> described v l j o) ->
  (forall j o, line_at 0 ls j o -> defined v l j o) /\
  (forall p s, place_in most u st cofactor_hint p s = true ->
    value (left s) <= v (at_first p) <= value (right s) /\ value (low s) <= v (at_second p) <= value (high s)) /\
  (forall f, fact_holds most u st cofactor_hint f = true -> fact_true v f).
Proof.
  intros U E A D. destruct (run_ok v l most root_hint zero_hint u U _ (pi_holds most pi_hint u U) ls nothing 0 st E
    (nothing_ok v l u) A D) as [S F].
  split; [exact F |]. split; [intros p s; exact (place_in_ok v l most u U st S cofactor_hint p s) | intros f;
    exact (fact_holds_ok v l most u U st S cofactor_hint f)].
Qed.
